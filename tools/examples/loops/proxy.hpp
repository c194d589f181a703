#pragma once

#include <Eigen/Core>
#include <span>

namespace loops {

/// A plane that the instrument must not go through: it may move by `d` where `direction · d + separation ≥
/// 0`.
struct ConstraintPlane {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of length 1
  double separation = 0;  ///< mm, negative if the instrument is behind the plane

  /// Returns how far behind the plane a way leads, or a negative number if it does not.
  [[nodiscard]] double violation(const Eigen::Vector3d& way) const {
    return -separation - direction.dot(way);
  }
};

/// Returns the shortest way from where the hand holds the instrument to where no plane is violated: the
/// proxy. Up to three planes hold it. This is the god-object of Zilles and Salisbury (A constraint-based
/// god-object method for haptic display, 1995), for an instrument that moves without turning.
Eigen::Vector3d way_to_proxy(std::span<const ConstraintPlane> planes);

}  // namespace loops
