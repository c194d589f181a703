#pragma once

#include <Eigen/Core>
#include <limits>

#include "core/surface/surface.hpp"

namespace graze {

/// How a leaf has moved since rest: as a rigid body, and by how much it did not. Two points of a leaf that
/// hardly bends stay about as far apart as they were.
struct LeafMotion {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  /// At least how far any corner of the leaf's features is from where `turn · rest + shift` has it. Infinite
  /// where nothing is known.
  double off = std::numeric_limits<double>::infinity();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the leaf at rest: one of its corners
  double radius = 0;  ///< at least how far any of its corners is from there at rest
};

/// The motion of a leaf's features, by three of their corners that are far apart at rest.
LeafMotion motion_of_leaf(const Surface& surface, const Region& leaf);

/// At most how much nearer to each other any point of one leaf and any of the other have come since rest,
/// as a difference of distances. Infinite where nothing is known.
double approach_since_rest(const LeafMotion& a, const LeafMotion& b);

}  // namespace graze
