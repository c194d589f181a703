#pragma once

#include <Eigen/Core>
#include <cmath>

namespace graze {

/// One over the squared sine of 10.2°. By so much a direction may lie outside of a normal cone and still
/// count as one of it.
inline constexpr double inverse_squared_lean = 32;

/// The part of a way from an end of an edge that is square to the edge. `along` is the edge from end to end.
inline Eigen::Vector3d square_to(const Eigen::Vector3d& along, const Eigen::Vector3d& way) {
  return way - along * (way.dot(along) / along.squaredNorm());
}

/// Whether a way along a surface leads along a direction, of length 1, by more than 10.2°: whether it rises
/// that steeply over the plane square to the direction.
inline bool leads_along(const Eigen::Vector3d& way, const Eigen::Vector3d& direction) {
  return way.dot(direction) > std::sqrt(1 / inverse_squared_lean) * way.norm();
}

}  // namespace graze
