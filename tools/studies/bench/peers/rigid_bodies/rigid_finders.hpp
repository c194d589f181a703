#pragma once

#include <memory>
#include <span>

#include "bench/rigid_bodies/rigid_contacts.hpp"

// What finds contacts of rigid bodies in the module. Bullet's file is built only where its package is
// installed.
namespace graze::bench {

/// Faces of convex parts, clipped to each other by code written by hand for that task alone.
std::unique_ptr<RigidContactFinder> make_clipped_faces(std::span<const RigidBodyView> bodies,
                                                       double contact_distance);

/// Bullet's boxes beside boxes. Bodies have to be boxes.
std::unique_ptr<RigidContactFinder> make_bullet_boxes(std::span<const RigidBodyView> bodies,
                                                      double contact_distance);
/// Bullet's convex hulls, several of them as one compound.
std::unique_ptr<RigidContactFinder> make_bullet_hulls(std::span<const RigidBodyView> bodies,
                                                      double contact_distance);
/// Bullet's meshes that move, GImpact.
std::unique_ptr<RigidContactFinder> make_bullet_meshes(std::span<const RigidBodyView> bodies,
                                                       double contact_distance);

}  // namespace graze::bench
