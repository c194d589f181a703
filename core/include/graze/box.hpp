#pragma once

#include <Eigen/Core>
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

}  // namespace graze
