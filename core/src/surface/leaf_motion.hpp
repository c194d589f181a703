#pragma once

#include <Eigen/Core>
#include <limits>

#include "core/base/box.hpp"
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
};

/// The motion of a leaf's features. It turns as three of their corners do that are far apart at rest, and
/// lies in the middle of all of them. `rest_box` holds the corners at rest.
LeafMotion motion_of_leaf(const Surface& surface, const Region& leaf, const Box& rest_box);

/// Features of two leaves that were at least `gap` apart at rest have come nearer to each other by at most
/// so much: they are now at least `gap` less this number apart. Infinite where nothing is known. The boxes
/// hold the corners of the leaves at rest.
double approach_since_rest(const LeafMotion& a, const Box& rest_box_a, const LeafMotion& b,
                           const Box& rest_box_b, double gap);

}  // namespace graze
