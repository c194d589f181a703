#pragma once

#include <memory>
#include <span>
#include <string>

#include "bench/rigid_bodies/rigid_body_scenes.hpp"
#include "bench/rigid_bodies/rigid_contacts.hpp"
#include "rigid/contact.hpp"

namespace graze::bench {

/// What finds contacts for the solver. All look as far for them.
struct RigidBodySource {
  std::string name;
  std::unique_ptr<rigid::ContactSource> contacts;
};

inline constexpr double rigid_contact_distance = 0.02;  // m

/// Returns all that a scene is measured with: graze with all its contacts and with those that carry, then
/// those of the module that take such bodies.
std::vector<RigidBodySource> rigid_body_sources(const RigidBodyScene& scene,
                                                std::span<const RigidContactEntry> entries);

}  // namespace graze::bench
