#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "bench/contender.hpp"
#include "bench/rays/ray_caster.hpp"
#include "bench/rigid_bodies/rigid_contacts.hpp"
#include "bench/self/self_contacts.hpp"
#include "bench/soft_bodies/soft_contacts.hpp"

namespace graze::bench {

/// The module with all contenders but graze, which stands beside the program. It stays loaded for good.
class PeerModule {
 public:
  /// Throws io::InputError where it cannot be loaded.
  PeerModule();

  [[nodiscard]] PeerList entries() const { return entries_; }
  /// The entry of a name. Throws io::InputError where there is none.
  [[nodiscard]] const PeerEntry& entry(std::string_view name) const;
  /// Whether the module was built with a library that finds contacts of soft bodies.
  [[nodiscard]] bool has_soft_contact_finder() const { return make_soft_contact_finder_ != nullptr; }
  /// Returns null where it was not.
  [[nodiscard]] std::unique_ptr<SoftContactFinder> soft_contact_finder(
      std::span<const SoftBodyView> bodies, const SoftContactSettings& settings) const;
  /// Returns null where the module was built without a library that casts rays.
  [[nodiscard]] std::unique_ptr<RayCaster> ray_caster(const World& world, RayTree tree,
                                                      unsigned threads) const;
  /// Returns null where the module was built without a library that finds contacts of a surface with itself.
  [[nodiscard]] std::unique_ptr<SelfContactFinder> self_contact_finder(const SelfSurface& surface,
                                                                       double distance) const;
  /// All ways to find contacts of rigid bodies.
  [[nodiscard]] std::span<const RigidContactEntry> rigid_contact_finders() const {
    return rigid_contact_finders_;
  }
  /// Compiler flags.
  [[nodiscard]] std::string compiled_for() const { return std::string(compiled_for_); }

 private:
  PeerList entries_;
  std::string_view compiled_for_;
  MakeSoftContactFinder make_soft_contact_finder_ = nullptr;
  MakeRayCaster make_ray_caster_ = nullptr;
  MakeSelfContactFinder make_self_contact_finder_ = nullptr;
  std::span<const RigidContactEntry> rigid_contact_finders_;
};

}  // namespace graze::bench
