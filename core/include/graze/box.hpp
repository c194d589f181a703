#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace graze {

/// An axis-aligned box; empty until a point is added.
struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void add(const Eigen::Vector3d& point) {
    for (int axis = 0; axis < 3; ++axis) {
      if (point[axis] < min[axis]) min[axis] = point[axis];
      if (point[axis] > max[axis]) max[axis] = point[axis];
    }
  }
  void add(const Box& other) {
    add(other.min);
    add(other.max);
  }
  [[nodiscard]] bool empty() const { return min.x() > max.x(); }
};

/// Factors that make a distance of a handful of rounded operations certain: each rounds by at most 2^-53 of
/// its result, and below fewer than eight follow one another.
inline constexpr double round_down = 1 - 0x1p-50;
inline constexpr double round_up = 1 + 0x1p-50;

/// At least what the root of a sum of three squares is off by where squares lose below the smallest denormal:
/// sqrt(3 · 2^-1075).
inline constexpr double lost_to_underflow = 0x1p-536;

/// The box grown on every side by at least `by`.
inline Box grown(const Box& box, double by) {
  Box result;
  for (int axis = 0; axis < 3; ++axis) {
    const double slack = (std::max(std::abs(box.min[axis]), std::abs(box.max[axis])) + by) * 0x1p-50;
    result.min[axis] = box.min[axis] - by - slack;
    result.max[axis] = box.max[axis] + by + slack;
  }
  return result;
}

/// Where two boxes overlap; empty where they do not.
inline Box common(const Box& a, const Box& b) {
  const Box box{a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)};
  return (box.min.array() <= box.max.array()).all() ? box : Box{};
}

inline bool contains(const Box& box, const Eigen::Vector3d& point) {
  return (point.array() >= box.min.array()).all() && (point.array() <= box.max.array()).all();
}

/// At most the distance of any two points of the boxes; 0 where they overlap.
inline double lower_distance(const Box& a, const Box& b) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = std::max(0.0, std::max(a.min[axis] - b.max[axis], b.min[axis] - a.max[axis]));
    squared += gap * gap;
  }
  if (squared == 0) return 0;
  return std::max(0.0, std::sqrt(squared) - lost_to_underflow) * round_down;
}

}  // namespace graze
