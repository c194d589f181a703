#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <graze/box.hpp>
#include <graze/surface.hpp>

#include "region_pair.hpp"

namespace graze {

/// At least the distance of two points.
inline double upper_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (b - a).norm() * round_up + lost_to_underflow;
}

/// At most the distance of two points.
inline double lower_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::max(0.0, (b - a).norm() - lost_to_underflow) * round_down;
}

/// At most the distance of any vertex within `radius_a` of `middle_a` and any within `radius_b` of
/// `middle_b`, for radii that are rounded themselves.
inline double lower_distance(const Eigen::Vector3d& middle_a, double radius_a,
                             const Eigen::Vector3d& middle_b, double radius_b) {
  const double radii = (radius_a + radius_b) * round_up + 2 * lost_to_underflow;
  return std::max(0.0, (lower_distance(middle_a, middle_b) - radii) * round_down);
}

/// The certified bound of method.md, section 2: no vertices of two regions are nearer. The better of the
/// spheres about the middle vertices (eq. 2) and the boxes; both surfaces are refitted by vertices.
inline double vertex_lower_distance(const Surface& a, const Surface& b, const RegionPair& pair) {
  const Region& region_a = a.mesh().regions().region(pair.a);
  const Region& region_b = b.mesh().regions().region(pair.b);
  return std::max(
      lower_distance(a.vertex_boxes()[pair.a], b.vertex_boxes()[pair.b]),
      lower_distance(a.middle(region_a), a.radii()[pair.a], b.middle(region_b), b.radii()[pair.b]));
}

}  // namespace graze
