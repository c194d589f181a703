#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/box.hpp"

namespace graze {

/// The points origin + t · (head − tail) for t from 0 to `limit`. The difference is not rounded, so a ray
/// along a vector and the way from one point to another are both exact. The difference is not 0.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d head;
  Eigen::Vector3d tail = Eigen::Vector3d::Zero();
  double limit = std::numeric_limits<double>::infinity();

  /// The difference, rounded.
  [[nodiscard]] Eigen::Vector3d direction() const { return head - tail; }
};

/// Finds where a ray enters boxes.
class RayBoxTest {
 public:
  explicit RayBoxTest(const Ray& ray) : origin_(ray.origin) {
    const Eigen::Vector3d direction = ray.direction();
    for (int axis = 0; axis < 3; ++axis) {
      Axis& of_axis = axes_[static_cast<std::size_t>(axis)];
      const double size = std::abs(direction[axis]);
      of_axis.is_parallel = size == 0;
      of_axis.is_unsure = size < 0x1p-1000;
      of_axis.inverse = of_axis.is_unsure ? 0 : 1 / direction[axis];
    }
  }

  /// Returned by `entry` where the ray misses the box.
  static constexpr double miss = std::numeric_limits<double>::infinity();

  /// A lower bound of the first t up to `limit` at which the ray is in the box, or `miss` if it certainly
  /// never is.
  [[nodiscard]] double entry(const Box& box, double limit) const {
    double first = 0;
    double last = limit;
    for (int axis = 0; axis < 3; ++axis) {
      const Axis& of_axis = axes_[static_cast<std::size_t>(axis)];
      const double to_min = box.min[axis] - origin_[axis];
      const double to_max = box.max[axis] - origin_[axis];
      if (of_axis.is_unsure) {
        if (of_axis.is_parallel && (to_min > 0 || to_max < 0)) return miss;
        continue;
      }
      const bool ascends = of_axis.inverse > 0;
      const double enters = (ascends ? to_min : to_max) * of_axis.inverse;
      const double leaves = (ascends ? to_max : to_min) * of_axis.inverse;
      // Four roundings at most, and what underflow loses.
      first = std::max(first, enters * (1 - 0x1p-49) - 0x1p-1000);
      last = std::min(last, leaves * (1 + 0x1p-49) + 0x1p-1000);
    }
    if (first <= last) return first;
    return miss;
  }

 private:
  struct Axis {
    double inverse = 0;
    bool is_parallel = false;
    bool is_unsure = false;  ///< the ray is parallel to the planes, or too nearly for a quotient
  };

  Eigen::Vector3d origin_;
  std::array<Axis, 3> axes_;
};

}  // namespace graze
