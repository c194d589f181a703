#include "bench/peers/rigid_bodies/placed_hull.hpp"

#include <limits>

namespace graze::bench {

void PlacedHull::place(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin) {
  axes = rotation;
  middle = rotation * hull->middle + origin;
  points.resize(hull->points.size());
  low.setConstant(std::numeric_limits<double>::infinity());
  high = -low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = rotation * hull->points[i] + origin;
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  normals.resize(hull->faces.size());
  offsets.resize(hull->faces.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    normals[i] = rotation * hull->faces[i].normal;
    offsets[i] = hull->faces[i].offset + normals[i].dot(origin);
  }
}

std::uint32_t PlacedHull::face_along(const Eigen::Vector3d& direction) const {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < normals.size(); ++i)
    if (normals[i].dot(direction) > normals[best].dot(direction)) best = i;
  return best;
}

bool are_near(const PlacedHull& a, const PlacedHull& b, double distance) {
  return (a.low.array() - distance < b.high.array()).all() &&
         (b.low.array() - distance < a.high.array()).all();
}

}  // namespace graze::bench
