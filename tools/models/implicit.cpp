#include "models/implicit.hpp"

#include <algorithm>
#include <cmath>

namespace graze::models {

namespace {

Eigen::Vector3d gradient(const Field& field, const Eigen::Vector3d& p) {
  constexpr double step = 1e-4;
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d offset = step * Eigen::Vector3d::Unit(axis);
    result[axis] = (field(p + offset) - field(p - offset)) / (2 * step);
  }
  return result;
}

}  // namespace

double limb(const Eigen::Vector3d& p, const Eigen::Vector3d& from, double from_radius,
            const Eigen::Vector3d& to, double to_radius) {
  const Eigen::Vector3d way = to - from;
  const double t = std::clamp((p - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p - from - t * way).norm() - (from_radius + t * (to_radius - from_radius));
}

double ellipsoid(const Eigen::Vector3d& p, const Eigen::Vector3d& centre, const Eigen::Vector3d& radii) {
  const Eigen::Vector3d scaled = (p - centre).cwiseQuotient(radii);
  const double length = scaled.norm();
  const double slope = scaled.cwiseQuotient(radii).norm();
  return slope == 0 ? -radii.minCoeff() : length * (length - 1) / slope;
}

double blended(double first, double second, double width) {
  const double overlap = std::max(width - std::abs(first - second), 0.0) / width;
  return std::min(first, second) - overlap * overlap * width / 4;
}

double carved(double body, double tool, double width) {
  return -blended(-body, tool, width);
}

Eigen::Vector3d on_surface(const Field& field, Eigen::Vector3d p) {
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d slope = gradient(field, p);
    const double squared = slope.squaredNorm();
    if (squared < 1e-12) break;
    p -= field(p) / squared * slope;
  }
  return p;
}

Eigen::Vector3d normal_at(const Field& field, const Eigen::Vector3d& p) {
  return gradient(field, p).normalized();
}

}  // namespace graze::models
