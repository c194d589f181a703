#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/rigid_bodies/rigid_body_shapes.hpp"
#include "rigid/body.hpp"

namespace graze::bench {

/// Rigid bodies, and how long they are played. Body 0 is the floor, whose top is at z = 0.
struct RigidBodyScene {
  std::string name;
  std::vector<rigid::Body> bodies;  ///< as they start
  std::vector<RigidBodyShapePtr> shapes;
  std::vector<double> heights;  ///< m, of each body's centre where it stands, but the floor's. Empty where
                                ///< bodies fall about
  std::size_t steps = 0;        ///< of 1/60 s

  [[nodiscard]] bool is_convex() const;
};

/// Returns stacks of ten crates in six placements, planks across planks, a pile of 150 crates that falls, and
/// a heap of L shapes, rings and pawns. A quick study has fewer bodies and steps.
std::vector<RigidBodyScene> rigid_body_scenes(bool is_quick);

}  // namespace graze::bench
