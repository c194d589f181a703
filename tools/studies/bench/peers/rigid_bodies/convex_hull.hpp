#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace graze::bench {

/// A convex body with polygons as faces.
struct ConvexHull {
  struct Face {
    Eigen::Vector3d normal;              ///< of length 1, outward
    double offset = 0;                   ///< of the plane: points p on it have normal · p = offset
    std::vector<std::uint32_t> corners;  ///< counter-clockwise from outside
  };
  struct Edge {
    std::uint32_t from = 0, to = 0;
    std::uint32_t left = 0, right = 0;  ///< the faces beside it
  };
  std::vector<Eigen::Vector3d> points;
  std::vector<Face> faces;
  std::vector<Edge> edges;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

/// Returns the hull of points that do not lie in one plane. It tries every plane through three of them, which
/// is good enough for a few dozen points.
ConvexHull hull_of(std::span<const Eigen::Vector3d> points);

}  // namespace graze::bench
