#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "core/base/box.hpp"

namespace graze {

/// The box of points that move along straight lines from time 0 to time 1. In between, the box whose sides
/// move from those of `start` to those of `end` holds the points.
struct MovingBox {
  Box start;
  Box end;

  /// Makes the box large enough for a point on its way.
  void add(const Eigen::Vector3d& at_start, const Eigen::Vector3d& at_end) {
    start.add(at_start);
    end.add(at_end);
  }
  void add(const MovingBox& other) {
    start.add(other.start);
    end.add(other.end);
  }
  /// Returns the box of all that the points pass.
  [[nodiscard]] Box whole() const {
    Box box = start;
    box.add(end);
    return box;
  }
  /// Returns the longest side that the box has at its start or at its end.
  [[nodiscard]] double size() const {
    return std::max((start.max - start.min).maxCoeff(), (end.max - end.min).maxCoeff());
  }
};

/// Returns the moving box grown on every side by at least `by`.
inline MovingBox grown(const MovingBox& box, double by) {
  return {grown(box.start, by), grown(box.end, by)};
}

/// Returns a lower bound of the first time in [0, 1] at which two moving boxes overlap or touch. It is above
/// 1 if they certainly never do. Coordinates are at most 2^120 in magnitude.
///
/// Along each axis two sides pass each other at most once. The difference of their coordinates is rounded
/// once, so that its sign is right. What has opposite signs is subtracted without cancellation. So times are
/// off by less than 2^-50 of themselves, but for underflow.
inline double first_meeting(const MovingBox& a, const MovingBox& b) {
  constexpr double never = 2;
  constexpr double lost_time = 0x1p-1000;
  double first = 0;
  double last = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double at_start[2] = {b.start.max[axis] - a.start.min[axis], a.start.max[axis] - b.start.min[axis]};
    const double at_end[2] = {b.end.max[axis] - a.end.min[axis], a.end.max[axis] - b.end.min[axis]};
    for (int side = 0; side < 2; ++side) {
      const double from = at_start[side];
      const double to = at_end[side];
      if (from >= 0 && to >= 0) continue;
      if (from < 0 && to < 0) return never;
      const double time = from / (from - to);
      if (from < 0)
        first = std::max(first, time * round_down - lost_time);
      else
        last = std::min(last, time * round_up + lost_time);
    }
  }
  return first <= last ? first : never;
}

}  // namespace graze
