#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <graze/box.hpp>

namespace graze {

/// How far the boxes of many features are from one box, squared: no square root, and no function call for
/// each.
class NearBox {
 public:
  NearBox(const Box& box, double limit)
      : box_(box), limit_squared_(limit * limit * round_up * round_up + lost_squares) {}

  /// 0 for the points of a feature that may touch something in the box.
  template <std::size_t Count>
  [[nodiscard]] double gap_squared(const std::array<Eigen::Vector3d, Count>& points) const {
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double low = points[0][axis];
      double high = low;
      for (std::size_t i = 1; i < Count; ++i) {
        low = std::min(low, points[i][axis]);
        high = std::max(high, points[i][axis]);
      }
      const double gap = std::max(std::max(low - box_.max[axis], box_.min[axis] - high), 0.0);
      squared += gap * gap;
    }
    return squared;
  }
  /// Whether a feature so far away may be within the limit.
  [[nodiscard]] bool is_near(double gap_squared) const { return !(gap_squared > limit_squared_); }

 private:
  /// More than a few squares are off by where they are rounded to denormals.
  static constexpr double lost_squares = 0x1p-1070;

  const Box& box_;
  double limit_squared_;
};

}  // namespace graze
