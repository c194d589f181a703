#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "naming.hpp"

namespace graze {

/// What parallel pieces have in common when each is seen along the gap between them: a stretch or a convex
/// area.
struct Overlap {
  Eigen::Vector3d middle_a;              ///< of the common stretch, or the centroid of the common area, on a
  Eigen::Vector3d middle_b;              ///< the same on b
  double size = 0;                       ///< length or area
  std::vector<Eigen::Vector3d> outline;  ///< its corners in order
};

/// The overlap of the relative interiors of two parallel pieces of at least two points each (edges, folds,
/// triangles); nothing where they are not exactly parallel, or overlap in no length or area. Whether is
/// decided exactly; the middles are rounded. `fold_side` of a triangle is the side (0-1, 1-2, 2-0) that is
/// inside its face, 3 for none.
std::optional<Overlap> overlap_of(const Simplex& a, std::size_t fold_side_a, const Simplex& b,
                                  std::size_t fold_side_b, DecisionCount& count);

/// The largest connected part of the overlaps of two features' pieces (at least one), with its middle.
/// Rounded.
Overlap largest_part(const std::vector<Overlap>& overlaps);

}  // namespace graze
