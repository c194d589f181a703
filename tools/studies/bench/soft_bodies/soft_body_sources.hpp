#pragma once

#include <memory>
#include <vector>

#include "bench/peer_module.hpp"
#include "bench/soft_bodies/soft_body_scenes.hpp"
#include "bench/soft_bodies/soft_contacts.hpp"
#include "examples/support/world.hpp"

namespace graze::bench {

/// Gives a step of the solver its constraints.
class ContactSource {
 public:
  ContactSource() = default;
  virtual ~ContactSource() = default;
  ContactSource(const ContactSource&) = delete;
  ContactSource& operator=(const ContactSource&) = delete;

  /// Replaces constraints by those of the world's bodies as they are now. This is what is timed.
  virtual void find(examples::World& world, std::vector<examples::ContactConstraint>& constraints) = 0;
};

/// Returns the source that the examples have: a step of the world's own scene.
std::unique_ptr<ContactSource> graze_source();

/// Returns Bullet as the source, for a world that is filled already. `kinds` says what each body is. Returns
/// null where the module was built without Bullet's soft bodies.
std::unique_ptr<ContactSource> bullet_source(const PeerModule& module, examples::World& world,
                                             const std::vector<SoftBodyKind>& kinds,
                                             const SoftContactSettings& settings);

}  // namespace graze::bench
