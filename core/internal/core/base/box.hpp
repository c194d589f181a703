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

/// At most the distance of any two points of the boxes; 0 where they overlap. Without a branch: whether boxes
/// overlap along an axis is as good as random where trees are walked, and a branch for each took three times
/// as long.
inline double lower_distance(const Box& a, const Box& b) {
  // Two axes a register, y in both.
  const Eigen::Array2d below_xy = a.min.head<2>() - b.max.head<2>();
  const Eigen::Array2d above_xy = b.min.head<2>() - a.max.head<2>();
  const Eigen::Array2d below_yz = a.min.tail<2>() - b.max.tail<2>();
  const Eigen::Array2d above_yz = b.min.tail<2>() - a.max.tail<2>();
  const Eigen::Array2d xy = below_xy.max(above_xy).max(0.0).square();
  const Eigen::Array2d yz = below_yz.max(above_yz).max(0.0).square();
  return std::max(0.0, std::sqrt(xy[0] + xy[1] + yz[1]) - lost_to_underflow) * round_down;
}

}  // namespace graze
