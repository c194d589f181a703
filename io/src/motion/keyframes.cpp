#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <graze/error.hpp>
#include <graze/io/keyframes.hpp>
#include <numbers>

namespace graze::io {
namespace {

struct CosSin {
  double cos;
  double sin;
};

/// std::cos and std::sin of π/2 are not 0 and 1 to the last bit. A quarter turn of a box should be.
CosSin cos_sin_degrees(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (turn == 0) return {1, 0};
  if (turn == 90) return {0, 1};
  if (turn == -90) return {0, -1};
  if (std::abs(turn) == 180) return {-1, 0};
  const double radians = turn * (std::numbers::pi / 180);
  return {std::cos(radians), std::sin(radians)};
}

Eigen::Isometry3d make_pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  pose.translation() = translation;
  return pose;
}

Eigen::Isometry3d pose_of(const KeyPose& key) {
  return make_pose(key.rotation, key.translate);
}

Eigen::Isometry3d pose_between(const KeyPose& before, const KeyPose& after, double part) {
  const Eigen::Vector3d translation = before.translate + part * (after.translate - before.translate);
  if (before.rotation == after.rotation) return make_pose(before.rotation, translation);
  const Eigen::Quaterniond from(before.rotation);
  const Eigen::Quaterniond to(after.rotation);
  return make_pose(from.slerp(part, to).normalized().toRotationMatrix(), translation);
}

}  // namespace

Eigen::Isometry3d Placement::pose() const {
  return make_pose(rotation, translate);
}

Eigen::Vector3d Placement::apply(const Eigen::Vector3d& point) const {
  return rotation * (stretch * point) + translate;
}

bool Placement::is_identity() const {
  return translate.isZero(0) && rotation == Eigen::Matrix3d::Identity() &&
         stretch == Eigen::Matrix3d::Identity();
}

Placement placement_from_matrix(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) throw Error("a number is not finite");
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) throw Error("its last row is not 0 0 0 1");
  const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
  Placement placement;
  placement.translate = matrix.topRightCorner<3, 1>();
  if (linear.transpose() * linear == Eigen::Matrix3d::Identity() && linear.determinant() > 0) {
    placement.rotation = linear;
    return placement;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d sizes = svd.singularValues();
  constexpr double flattest = 1e-12;
  if (!(sizes[2] > flattest * sizes[0])) throw Error("it flattens space");
  const double sign = linear.determinant() < 0 ? -1.0 : 1.0;
  placement.rotation = sign * svd.matrixU() * svd.matrixV().transpose();
  placement.stretch = sign * svd.matrixV() * sizes.asDiagonal() * svd.matrixV().transpose();
  return placement;
}

Eigen::Matrix3d rotation_from_degrees(const Eigen::Vector3d& degrees) {
  const auto [cx, sx] = cos_sin_degrees(degrees.x());
  const auto [cy, sy] = cos_sin_degrees(degrees.y());
  const auto [cz, sz] = cos_sin_degrees(degrees.z());
  const Eigen::Matrix3d x{{1, 0, 0}, {0, cx, -sx}, {0, sx, cx}};
  const Eigen::Matrix3d y{{cy, 0, sy}, {0, 1, 0}, {-sy, 0, cy}};
  const Eigen::Matrix3d z{{cz, -sz, 0}, {sz, cz, 0}, {0, 0, 1}};
  return z * y * x;
}

Eigen::Isometry3d pose_at(std::span<const KeyPose> keys, std::uint32_t frame) {
  const auto after = std::ranges::lower_bound(keys, frame, {}, &KeyPose::frame);
  if (after == keys.end()) return pose_of(keys.back());
  if (after == keys.begin() || after->frame == frame) return pose_of(*after);
  const KeyPose& before = *std::prev(after);
  const double part =
      static_cast<double>(frame - before.frame) / static_cast<double>(after->frame - before.frame);
  return pose_between(before, *after, part);
}

}  // namespace graze::io
