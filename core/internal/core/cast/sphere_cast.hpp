#pragma once

#include <Eigen/Core>
#include <graze/export.hpp>
#include <optional>

#include "core/cast/ray_cast.hpp"

namespace graze {

/// A sphere whose centre moves from one point to another, along a straight line. At t it is at
/// from + t · (to − from), for t from 0 to 1.
struct SphereSweep {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  double radius = 0;

  [[nodiscard]] Eigen::Vector3d centre(double t) const { return from + (to - from) * t; }
};

/// The first time at which a sphere touches a surface: its centre is at most its radius away.
struct SphereTouch {
  /// At most the first time. The gap between the two is then at most 2^-40 of the largest coordinate
  /// difference.
  double t = 0;
  TriangleOfFace triangle;  ///< the lowest one that has this t
};

/// Finds when a moving sphere first touches a surface. Returns nothing where it never does, or after `limit`.
/// Whether it does is decided exactly. Faces that `groups` hides do not count. A null pointer hides none. The
/// surface has been refitted for faces now.
GRAZE_API std::optional<SphereTouch> cast_sphere(const SphereSweep& sweep, const Surface& surface,
                                                 const FaceGroups* groups, double limit);

}  // namespace graze
