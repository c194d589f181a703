#include "examples/loops/instrument.hpp"

#include <cmath>
#include <numbers>

namespace loops {
namespace {

constexpr double radius = 3;    // mm
constexpr double length = 120;  // mm

/// Returns a rod along z, with the middle of its round tip at the origin.
Shape rod() {
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i <= 6; ++i) {
    const double angle = std::numbers::pi / 2 * (i / 6.0 - 1);
    line.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  line.emplace_back(radius, length);
  line.emplace_back(0, length);
  return rounded(examples::revolved(line, 12));
}

}  // namespace

Instrument::Instrument(const Eigen::Vector3d& target, const Eigen::Vector3d& outward, double phase)
    : mesh_(make_mesh(rod())), target_(target), phase_(phase) {
  axes_.col(2) = outward.normalized();
  axes_.col(0) = axes_.col(2).unitOrthogonal();
  axes_.col(1) = axes_.col(2).cross(axes_.col(0));
}

Eigen::Isometry3d Instrument::pose(double time) const {
  const double t = time + phase_;
  const double sideways = 6 * std::sin(3 * t) + 0.05 * std::sin(60 * t);  // mm
  const double forward = 4 * std::sin(2 * t) + 0.05 * std::sin(55 * t);
  const double outward = 3 + 6 * std::cos(2.5 * t) + 0.03 * std::sin(65 * t);
  const Eigen::Isometry3d turned =
      Eigen::Isometry3d(Eigen::AngleAxisd(0.15 * std::sin(1.5 * t), axes_.col(0)));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turned.linear() * axes_;
  pose.translation() = target_ + axes_ * Eigen::Vector3d(sideways, forward, outward);
  return pose;
}

}  // namespace loops
