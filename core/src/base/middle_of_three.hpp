#pragma once

#include <Eigen/Core>

namespace graze {

/// The middle coordinates of three points. One part of a surface that exploded takes no precision from the
/// rest where boxes are relative to it.
inline Eigen::Vector3d middle_of_three(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                                       const Eigen::Vector3d& third) {
  return first.cwiseMin(second).cwiseMax(first.cwiseMax(second).cwiseMin(third));
}

}  // namespace graze
