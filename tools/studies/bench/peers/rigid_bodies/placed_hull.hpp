#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bench/peers/rigid_bodies/convex_hull.hpp"

namespace graze::bench {

/// A convex body, or a part of one, where it is now.
struct PlacedHull {
  const ConvexHull* hull = nullptr;
  std::uint32_t body = 0;
  std::uint32_t part = 0;                          ///< of the body, from 0
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< of a box about the origin, 0 for any other body

  Eigen::Matrix3d axes;  ///< of its own coordinates
  Eigen::Vector3d middle;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< of faces
  std::vector<double> offsets;           ///< of the faces' planes
  Eigen::Vector3d low, high;             ///< of its bounding box

  [[nodiscard]] bool is_box() const { return half.x() > 0; }

  /// Moves it to a pose.
  void place(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin);

  /// Returns the face whose normal is nearest to a direction.
  [[nodiscard]] std::uint32_t face_along(const Eigen::Vector3d& direction) const;
};

/// Whether the bounding boxes are nearer than a distance along each axis.
bool are_near(const PlacedHull& a, const PlacedHull& b, double distance);

}  // namespace graze::bench
