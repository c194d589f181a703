#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <graze/export.hpp>
#include <span>

namespace graze::io {

/// @addtogroup io_motion
/// @{

/// Returns the rotation by three angles in degrees: about the fixed x axis first, then about y, then about z.
/// It is exact at multiples of 90 degrees.
GRAZE_API Eigen::Matrix3d rotation_from_degrees(const Eigen::Vector3d& degrees);

/// Says where an object stands. A point p of its file goes to `rotation * (stretch * p) + translate`.
struct GRAZE_API Placement {
  /// The translation, in units of the scene.
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  /// The rotation. It does not mirror.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  /// A scale, uniform or by axis, or what a 4 x 4 matrix does besides rotation and translation. Its
  /// determinant is not 0, and a negative one mirrors.
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();

  /// Returns the rotation and the translation, without the stretch.
  [[nodiscard]] Eigen::Isometry3d pose() const;
  /// Returns where a point of the file goes.
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point) const;
  /// Returns whether every point stays where it is.
  [[nodiscard]] bool is_identity() const;
};

/// Returns the placement that does what an affine 4 x 4 matrix does. Its rotation is the one nearest to the
/// linear part of the matrix.
///
/// Throws Error if the last row is not 0 0 0 1, if a number is not finite, or if the matrix flattens space.
GRAZE_API Placement placement_from_matrix(const Eigen::Matrix4d& matrix);

/// The pose of a rigid object at one frame.
struct KeyPose {
  /// The frame, counted from 0.
  std::uint32_t frame = 0;
  /// The translation, in units of the scene.
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();
  /// The rotation. It does not mirror.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

/// Returns the pose at `frame`. There is at least one key, and `keys` ascend by frame.
///
/// At the frame of a key the pose is that of the key. Between two keys the translation is linear, and the
/// rotation follows the shorter arc at constant speed (slerp). Before the first key and after the last one,
/// the pose is held.
GRAZE_API Eigen::Isometry3d pose_at(std::span<const KeyPose> keys, std::uint32_t frame);

/// @}

}  // namespace graze::io
