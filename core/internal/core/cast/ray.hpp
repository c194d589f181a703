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
      const double size = std::abs(direction[axis]);
      const bool is_unsure = size < 0x1p-1000;
      is_parallel_[static_cast<std::size_t>(axis)] = size == 0;
      some_unsure_ = some_unsure_ || is_unsure;
      inverse_[axis] = is_unsure ? 0 : 1 / direction[axis];
    }
  }

  /// Returned by `entry` where the ray misses the box.
  static constexpr double miss = std::numeric_limits<double>::infinity();

  /// A lower bound of the first t up to `limit` at which the ray is in the box, or `miss` if it certainly
  /// never is.
  [[nodiscard]] double entry(const Box& box, double limit) const {
    if (some_unsure_) return careful_entry(box, limit);
    const Eigen::Vector3d to_min = (box.min - origin_).cwiseProduct(inverse_);
    const Eigen::Vector3d to_max = (box.max - origin_).cwiseProduct(inverse_);
    return entry_between(to_min.cwiseMin(to_max).maxCoeff(), to_min.cwiseMax(to_max).minCoeff(), limit);
  }

 private:
  /// The entry of a ray that is between all planes of a box from time `enters` to `leaves`. Both times may be
  /// off by four roundings, and by what underflow loses.
  [[nodiscard]] static double entry_between(double enters, double leaves, double limit) {
    const double first = std::max(0.0, enters * (1 - 0x1p-49) - 0x1p-1000);
    const double last = std::min(limit, leaves * (1 + 0x1p-49) + 0x1p-1000);
    if (first <= last) return first;
    return miss;
  }
  /// `entry` of a ray that is parallel to some planes, or too nearly for a quotient.
  [[nodiscard]] double careful_entry(const Box& box, double limit) const {
    double enters = -std::numeric_limits<double>::infinity();
    double leaves = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double to_min = box.min[axis] - origin_[axis];
      const double to_max = box.max[axis] - origin_[axis];
      if (inverse_[axis] == 0) {
        if (is_parallel_[static_cast<std::size_t>(axis)] && (to_min > 0 || to_max < 0)) return miss;
        continue;
      }
      const double at_min = to_min * inverse_[axis];
      const double at_max = to_max * inverse_[axis];
      enters = std::max(enters, std::min(at_min, at_max));
      leaves = std::min(leaves, std::max(at_min, at_max));
    }
    return entry_between(enters, leaves, limit);
  }

  Eigen::Vector3d origin_;
  Eigen::Vector3d inverse_;  ///< of the direction, or 0 along an axis that `careful_entry` is for
  std::array<bool, 3> is_parallel_{};
  bool some_unsure_ = false;
};

}  // namespace graze
