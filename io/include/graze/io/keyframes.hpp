#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <graze/export.hpp>
#include <span>

namespace graze::io {

/// The rotation by degrees about the fixed x axis, then y, then z. It is exact at multiples of 90.
GRAZE_API Eigen::Matrix3d rotation_from_degrees(const Eigen::Vector3d& degrees);

/// The place of an object. A point p of its file goes to rotation · (stretch · p) + translate.
struct GRAZE_API Placement {
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< a proper rotation
  /// A scale, uniform or by axis, or the rest of a 4 × 4 matrix. Its determinant is not
  /// 0; a negative one mirrors.
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();

  /// Rotation and translation.
  [[nodiscard]] Eigen::Isometry3d pose() const;
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point) const;
  [[nodiscard]] bool is_identity() const;
};

/// The placement that does what an affine 4 × 4 matrix does: the rotation is the nearest one to its linear
/// part. Throws Error when its last row is not 0 0 0 1, a number is not finite, or it flattens space.
GRAZE_API Placement placement_from_matrix(const Eigen::Matrix4d& matrix);

/// The pose of a rigid object at one frame.
struct KeyPose {
  std::uint32_t frame = 0;
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

/// The pose at `frame`. At the keys' own frames it is theirs. In between the translation is linear and the
/// rotation follows the shorter arc at constant speed (slerp). Before the first and after the last key it is
/// held. `keys` ascend by frame; there is at least one.
GRAZE_API Eigen::Isometry3d pose_at(std::span<const KeyPose> keys, std::uint32_t frame);

}  // namespace graze::io
