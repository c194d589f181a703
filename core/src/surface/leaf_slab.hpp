#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "core/base/box.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// A tight bound of a leaf that is nearly flat: a cylinder between two planes, about the leaf's middle
/// vertex. It is in float, since a query keeps many.
struct LeafSlab {
  static constexpr float beyond = std::numeric_limits<float>::infinity();

  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of the planes. Its length is from 1 - 2^-20 to 1
  /// At most and at least any corner's height, the product of the normal and the way from the middle vertex.
  /// Infinite where nothing is known.
  float low = -beyond;
  float high = beyond;
  float radius = beyond;  ///< at least any corner's distance from the middle vertex

  [[nodiscard]] bool is_known() const { return high < beyond; }
};

/// The slab of the corners of a leaf's features.
LeafSlab slab_of(const Surface& surface, const Region& leaf);

/// Whether the contents of two slabs are certainly further apart than a distance. `between` is the way from
/// a's middle vertex to b's.
bool are_apart(const LeafSlab& a, const LeafSlab& b, const Eigen::Vector3d& between, double distance);

/// At most the squared distance of a point and the contents of a slab. `way` leads from the middle vertex to
/// the point.
double lower_squared(const LeafSlab& slab, const Eigen::Vector3d& way);

/// Whether slabs may say more than boxes about pairs within a distance: they do not where that is as large as
/// a leaf.
inline bool are_worth_slabs(const Box& a, const Box& b, double distance) {
  const double size = std::min((a.max - a.min).maxCoeff(), (b.max - b.min).maxCoeff());
  return distance < size;
}

}  // namespace graze
