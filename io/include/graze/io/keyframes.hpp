#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <graze/export.hpp>
#include <span>

namespace graze::io {

/// Where an object stands: a point p of its file goes to rotation · (scale · p) + translate.
struct GRAZE_API Placement {
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotate_degrees =
      Eigen::Vector3d::Zero();  ///< about the fixed axes, x first, then y, then z
  double scale = 1;

  /// Rotation and translation.
  [[nodiscard]] Eigen::Isometry3d pose() const;
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point) const;
  [[nodiscard]] bool is_identity() const;
};

/// The pose of a rigid object at one frame.
struct KeyPose {
  std::uint32_t frame = 0;
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotate_degrees = Eigen::Vector3d::Zero();
};

/// The rotation by degrees about the fixed x axis, then y, then z; exact at multiples of 90.
GRAZE_API Eigen::Matrix3d rotation_from_degrees(const Eigen::Vector3d& degrees);

/// The pose at `frame`: the keys' own at their frames, the translation linear and the rotation along the
/// shorter arc (slerp) in between, held before the first and after the last. `keys` ascend by frame; at least
/// one.
GRAZE_API Eigen::Isometry3d pose_at(std::span<const KeyPose> keys, std::uint32_t frame);

}  // namespace graze::io
