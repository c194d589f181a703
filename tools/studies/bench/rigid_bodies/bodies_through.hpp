#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bench/rigid_bodies/rigid_body_shapes.hpp"
#include "rigid/body.hpp"

namespace graze::bench {

/// A pair of bodies by index, the lower one first.
using BodyPair = std::pair<std::uint32_t, std::uint32_t>;

/// Which bodies are inside each other.
struct Overlaps {
  std::vector<BodyPair> deep;      ///< a point of one is deeper in the other than the limit
  std::vector<BodyPair> crossing;  ///< an edge of one passes through a triangle of the other
};

/// Finds bodies that are inside each other, by brute force in double. It uses nothing of graze: it adds up
/// solid angles, and compares all triangles near a point or an edge. The points that it tests are vertices
/// and points along long edges.
class BodiesThrough {
 public:
  /// Points are deep from a depth in m on. `shapes` has the shape of each body.
  BodiesThrough(std::span<const RigidBodyShapePtr> shapes, double depth);

  [[nodiscard]] Overlaps find(std::span<const rigid::Body> bodies);

 private:
  struct Solid {
    std::vector<Eigen::Vector3d> own_points;  ///< in the body's own coordinates, the vertices first
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Eigen::Vector3d> points;  ///< where they are now
    Eigen::Vector3d low, high;            ///< of all points
  };

  static Solid solid_of(const RigidShape& shape);
  static void place(Solid& solid, const rigid::Body& body);
  [[nodiscard]] static bool is_inside(const Eigen::Vector3d& point, const Solid& solid);
  /// Whether a point of `guest` is deep in `host`.
  [[nodiscard]] bool is_deep(const Solid& guest, const Solid& host) const;
  /// Whether an edge of `guest` passes through a triangle of `host`.
  [[nodiscard]] static bool does_pierce(const Solid& guest, const Solid& host);

  double depth_;
  std::vector<Solid> solids_;  ///< of each body
};

}  // namespace graze::bench
