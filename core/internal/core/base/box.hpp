#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace graze {

/// An axis-aligned box. It is empty until a point is added.
struct Box {
  /// The smallest coordinates, or infinity along each axis while the box is empty.
  Eigen::Vector3d min = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  /// The largest coordinates, or minus infinity along each axis while the box is empty.
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  /// Makes the box large enough for a point.
  void add(const Eigen::Vector3d& point) {
    for (int axis = 0; axis < 3; ++axis) {
      if (point[axis] < min[axis]) min[axis] = point[axis];
      if (point[axis] > max[axis]) max[axis] = point[axis];
    }
  }
  /// Makes the box large enough for another box.
  void add(const Box& other) {
    add(other.min);
    add(other.max);
  }
  /// Returns whether no point was added.
  [[nodiscard]] bool empty() const { return min.x() > max.x(); }
};

/// A factor that makes a computed distance certainly not larger than the true one. Each operation rounds by
/// at most 2^-53 of its result, and the functions here do fewer than eight of them one after the other.
inline constexpr double round_down = 1 - 0x1p-50;
/// A factor that makes a computed distance certainly not smaller than the true one, as `round_down` does the
/// other way.
inline constexpr double round_up = 1 + 0x1p-50;

/// At least the error of the root of a sum of three squares when squares are lost below the smallest denormal
/// number, which is sqrt(3 · 2^-1075).
inline constexpr double lost_to_underflow = 0x1p-536;

/// Returns the box grown on every side by at least `by`.
inline Box grown(const Box& box, double by) {
  Box result;
  for (int axis = 0; axis < 3; ++axis) {
    const double slack = (std::max(std::abs(box.min[axis]), std::abs(box.max[axis])) + by) * 0x1p-50;
    result.min[axis] = box.min[axis] - by - slack;
    result.max[axis] = box.max[axis] + by + slack;
  }
  return result;
}

/// Returns the box of all points that are in both boxes. It is empty if the boxes do not overlap.
inline Box common(const Box& a, const Box& b) {
  const Box box{a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)};
  return (box.min.array() <= box.max.array()).all() ? box : Box{};
}

/// Returns whether two boxes have a common point. Points on their borders count.
inline bool do_meet(const Box& a, const Box& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

/// Returns whether a point is in a box. Points on its border are.
inline bool contains(const Box& box, const Eigen::Vector3d& point) {
  return (point.array() >= box.min.array()).all() && (point.array() <= box.max.array()).all();
}

/// Returns a lower bound of the distance of any two points of the boxes. It is 0 if the boxes overlap.
///
/// The code has no branch. When trees are walked, chance decides whether boxes overlap along an axis, and a
/// branch for each axis took three times as long.
inline double lower_distance(const Box& a, const Box& b) {
  // A register holds two axes, and y is in both registers.
  const Eigen::Array2d below_xy = a.min.head<2>() - b.max.head<2>();
  const Eigen::Array2d above_xy = b.min.head<2>() - a.max.head<2>();
  const Eigen::Array2d below_yz = a.min.tail<2>() - b.max.tail<2>();
  const Eigen::Array2d above_yz = b.min.tail<2>() - a.max.tail<2>();
  const Eigen::Array2d xy = below_xy.max(above_xy).max(0.0).square();
  const Eigen::Array2d yz = below_yz.max(above_yz).max(0.0).square();
  return std::max(0.0, std::sqrt(xy[0] + xy[1] + yz[1]) - lost_to_underflow) * round_down;
}

}  // namespace graze
