#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <graze/graze.hpp>
#include <vector>

namespace examples {

/// A convex body, for a measure of how deep two of them are in each other. It is independent of contacts.
class ConvexBody {
 public:
  /// Takes a closed mesh that is convex, in its rest positions.
  explicit ConvexBody(const graze::Mesh& mesh);

  /// Returns how far the furthest point is from the origin of the mesh.
  [[nodiscard]] double radius() const { return radius_; }

 private:
  friend double overlap(const ConvexBody& a, const Eigen::Isometry3d& pose_a, const ConvexBody& b,
                        const Eigen::Isometry3d& pose_b);
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> normals_;  ///< of faces, each direction once
  std::vector<Eigen::Vector3d> edges_;    ///< directions of edges between faces that are not flat, each once
  double radius_ = 0;
};

/// Returns how far two convex bodies have to move until they are apart, by the shortest way, in m. It is
/// negative where they are apart: a lower bound of their gap, with its sign turned.
[[nodiscard]] double overlap(const ConvexBody& a, const Eigen::Isometry3d& pose_a, const ConvexBody& b,
                             const Eigen::Isometry3d& pose_b);

}  // namespace examples
