#pragma once

#include <Eigen/Core>
#include <cmath>

namespace graze {

/// Coordinates beyond this are refused: products of the degree that the kernels need would leave double's
/// range.
inline constexpr double largest_coordinate = 0x1p120;

/// Also false for NaN.
inline bool is_within_limits(const Eigen::Vector3d& point) {
  return std::abs(point.x()) <= largest_coordinate && std::abs(point.y()) <= largest_coordinate &&
         std::abs(point.z()) <= largest_coordinate;
}

}  // namespace graze
