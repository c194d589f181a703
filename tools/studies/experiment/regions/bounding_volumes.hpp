#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/box.hpp"

// Bounds that a region may carry. Each kind of bound is a class `Volume`. Its `name` is a static constexpr
// const char*. Its function `around(points)` makes the bound of all points of a region, which has one at
// least. Its constant `merges` says whether `add` gives what `around` gives for all points. Only bounds that
// merge have `add(child)`, which extends a bound by a child's. The function `lower_distance(a, b)` gives at
// most the distance of any two points in the two bounds. Numbers are double in both kinds. Rounding is always
// to the safe side, by the factors of core/base/box.hpp.
namespace graze::tools {

/// The present positions of the points of one region.
struct RegionPoints {
  std::span<const Eigen::Vector3d> points;
  const Eigen::Vector3d& middle;  ///< of the middle vertex (eq. 1). Lives as long as the bound
};

/// At most the distance of any point within `radius_a` of `a` and any within `radius_b` of `b`.
inline double lower_distance_of_balls(const Eigen::Vector3d& a, double radius_a, const Eigen::Vector3d& b,
                                      double radius_b) {
  const double centres = std::max(0.0, (b - a).norm() - lost_to_underflow) * round_down;
  return std::max(0.0, (centres - (radius_a + radius_b) * round_up) * round_down);
}

/// At least how far any of the points is from `centre`.
inline double radius_about(const Eigen::Vector3d& centre, std::span<const Eigen::Vector3d> points) {
  double squared = 0;
  for (const Eigen::Vector3d& point : points) squared = std::max(squared, (point - centre).squaredNorm());
  return squared == 0 ? lost_to_underflow : std::sqrt(squared) * round_up + lost_to_underflow;
}

/// The paper's: about the middle vertex, where it is now, with the radius of eq. 2.
struct MiddleSphere {
  static constexpr const char* name = "middle-vertex sphere";
  static constexpr bool merges = false;

  const Eigen::Vector3d* middle = nullptr;
  double radius = 0;

  static MiddleSphere around(const RegionPoints& region) {
    return {&region.middle, radius_about(region.middle, region.points)};
  }
  friend double lower_distance(const MiddleSphere& a, const MiddleSphere& b) {
    return lower_distance_of_balls(*a.middle, a.radius, *b.middle, b.radius);
  }
};

/// The library's own.
struct AxisBox {
  static constexpr const char* name = "box";
  static constexpr bool merges = true;

  Box box;

  static AxisBox around(const RegionPoints& region) {
    AxisBox result;
    for (const Eigen::Vector3d& point : region.points) result.box.add(point);
    return result;
  }
  void add(const AxisBox& child) { box.add(child.box); }
  friend double lower_distance(const AxisBox& a, const AxisBox& b) {
    return graze::lower_distance(a.box, b.box);
  }
};

}  // namespace graze::tools
