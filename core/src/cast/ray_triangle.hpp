#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "arithmetic/arithmetic.hpp"
#include "arithmetic/certain.hpp"
#include "core/cast/ray.hpp"

namespace graze {

/// The first point that a ray and a triangle share.
struct RayMeeting {
  double t = 0;        ///< correctly rounded
  VoronoiRegion part;  ///< a corner, the inside of a side, or the inside of the triangle
};

/// Asks triangles whether a ray meets them. Decides exactly, so that a ray never passes between two triangles
/// with a common edge.
class RayTriangleTest {
 public:
  explicit RayTriangleTest(const Ray& ray);

  /// Says that the corners of the triangles that come are in a box.
  void begin(const Box& box);
  /// Returns nothing where the ray misses the triangle. It may, if they meet after `limit`.
  [[nodiscard]] std::optional<RayMeeting> meet(const std::array<Eigen::Vector3d, 3>& corner, double limit,
                                               DecisionCount& count) const;

 private:
  Ray ray_;
  Eigen::Vector3d direction_;
  double off_turn_ = 0;  ///< of a sign in double
};

}  // namespace graze
