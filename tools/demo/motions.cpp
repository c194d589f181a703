#include "motions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace graze::demo {
namespace {

/// 0 before `from`, 1 after `to`, smooth in between.
double rise(double frame, double from, double to) {
  const double part = std::clamp((frame - from) / (to - from), 0.0, 1.0);
  return part * part * (3 - 2 * part);
}

/// A damped swing that starts at `from`.
double shiver(double frame, double from) {
  if (frame < from) return 0;
  return std::exp(-(frame - from) / 14) * std::sin((frame - from) * 2 * std::numbers::pi / 11);
}

}  // namespace

Eigen::Vector3d ring_point(const Eigen::Vector3d& rest, int frame) {
  constexpr double size = 0.5;
  const double down = rise(frame, 0, 28) - rise(frame, 72, 108);
  const double pressed = rise(frame, 22, 32) - rise(frame, 70, 80);
  const double wobble = 0.35 * shiver(frame, 24) + 0.08 * std::sin(frame * 0.35);
  const double angle = std::atan2(rest.y(), rest.x());
  const double wide = size * (1 + 0.18 * pressed + 0.25 * wobble * std::cos(2 * angle));
  Eigen::Vector3d point(wide * rest.x(), wide * rest.y(), size * (1 - 0.25 * pressed) * rest.z());
  point.z() -= 0.22 * pressed * (point.y() * point.y()) / (size * size);  // hangs down on both flanks
  point.z() += 0.06 * wobble * std::sin(3 * angle);
  return point + Eigen::Vector3d(0.05, 0, 2.45 - 0.90 * down);
}

Eigen::Vector3d jelly_point(const Eigen::Vector3d& rest, int frame) {
  constexpr double size = 0.36;
  const double near = rise(frame, 20, 48) - rise(frame, 58, 90);
  const double swing = shiver(frame, 46);
  Eigen::Vector3d point = size * rest;
  point.y() *= 1 - 0.30 * swing;
  point.x() *= 1 + 0.15 * swing;
  point.y() += 0.25 * swing * rest.z() * size;  // sways
  const double twist = 0.5 * swing * rest.z();
  const Eigen::Vector3d turned(std::cos(twist) * point.x() - std::sin(twist) * point.y(),
                               std::sin(twist) * point.x() + std::cos(twist) * point.y(), point.z());
  return turned + Eigen::Vector3d(-0.15, -1.55 + 0.92 * near, 1.0 - 0.1 * near);
}

}  // namespace graze::demo
