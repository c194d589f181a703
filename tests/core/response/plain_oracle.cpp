#include "core/response/plain_oracle.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace graze::tests {
namespace {

using Eigen::Vector3d;

double distance_from_segment(const Vector3d& point, const Vector3d& p, const Vector3d& q) {
  const Vector3d along = q - p;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp(along.dot(point - p) / length, 0.0, 1.0) : 0;
  return (point - p - t * along).norm();
}

double distance_from_triangle(const Vector3d& point, const std::array<Vector3d, 3>& corners) {
  Eigen::Matrix<double, 3, 2> sides;
  sides << corners[1] - corners[0], corners[2] - corners[0];
  const Vector3d from = point - corners[0];
  const Eigen::Vector2d weights = sides.colPivHouseholderQr().solve(from);
  if (weights.minCoeff() >= 0 && weights.sum() <= 1) return (from - sides * weights).norm();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(least, distance_from_segment(point, corners[i], corners[(i + 1) % 3]));
  return least;
}

/// Visits the triangles of all faces, split from their first corners.
template <typename Visit>
void visit_triangles(const oracle::Shape& shape, const Visit& visit) {
  for (const auto& face : shape.faces)
    for (std::size_t last = 2; last < face.size(); ++last)
      visit(std::array<Vector3d, 3>{shape.positions[face[0]], shape.positions[face[last - 1]],
                                    shape.positions[face[last]]});
}

}  // namespace

double distance_from_surface(const Vector3d& point, const oracle::Shape& shape) {
  double least = std::numeric_limits<double>::infinity();
  visit_triangles(shape, [&](const std::array<Vector3d, 3>& corners) {
    const Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    const Vector3d beside = (low - point).cwiseMax(point - high).cwiseMax(0);
    if (beside.norm() < least) least = std::min(least, distance_from_triangle(point, corners));
  });
  return least;
}

double winding_about(const Vector3d& point, const oracle::Shape& closed) {
  double angle = 0;
  visit_triangles(closed, [&](const std::array<Vector3d, 3>& corners) {
    const Vector3d a = corners[0] - point;
    const Vector3d b = corners[1] - point;
    const Vector3d c = corners[2] - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  });
  return angle / (4 * std::numbers::pi);
}

}  // namespace graze::tests
