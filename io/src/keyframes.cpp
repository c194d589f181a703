#include <algorithm>
#include <cmath>
#include <graze/io/keyframes.hpp>
#include <numbers>

namespace graze::io {
namespace {

struct CosSin {
  double cos;
  double sin;
};

/// std::cos and std::sin of π/2 are not 0 and 1 to the last bit; a quarter turn of a box should be.
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
  return make_pose(rotation_from_degrees(key.rotate_degrees), key.translate);
}

Eigen::Isometry3d pose_between(const KeyPose& before, const KeyPose& after, double part) {
  const Eigen::Vector3d translation = before.translate + part * (after.translate - before.translate);
  const Eigen::Matrix3d first = rotation_from_degrees(before.rotate_degrees);
  if (before.rotate_degrees == after.rotate_degrees) return make_pose(first, translation);
  const Eigen::Quaterniond from(first);
  const Eigen::Quaterniond to(rotation_from_degrees(after.rotate_degrees));
  return make_pose(from.slerp(part, to).normalized().toRotationMatrix(), translation);
}

}  // namespace

Eigen::Isometry3d Placement::pose() const {
  return make_pose(rotation_from_degrees(rotate_degrees), translate);
}

Eigen::Vector3d Placement::apply(const Eigen::Vector3d& point) const {
  return rotation_from_degrees(rotate_degrees) * (scale * point) + translate;
}

bool Placement::is_identity() const {
  return translate.isZero(0) && rotate_degrees.isZero(0) && scale == 1;
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
