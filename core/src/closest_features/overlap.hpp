#pragma once

#include <Eigen/Core>

#include "base/inplace_vector.hpp"
#include "closest_features/closest_features.hpp"

namespace graze {

/// Coordinates about one corner of two features and of a size near 1, in which products neither vanish nor
/// overflow.
class LocalFrame {
 public:
  LocalFrame(const Surface& surface_a, const Feature& feature_a, const Surface& surface_b,
             const Feature& feature_b);
  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& point) const {
    return origin_ + point / scale_;
  }
  [[nodiscard]] Simplex to_local(Simplex simplex) const;

 private:
  Eigen::Vector3d origin_;
  double scale_;  ///< a power of two
};

/// The corners of a convex area in order, or the ends of a stretch. The common area of two triangles has at
/// most six corners, and a clip adds at most one. Where rounding would make more than fit, they lie within
/// rounding of others and are left out.
using Outline = InplaceVector<Eigen::Vector3d, 24>;

/// The common part of two parallel pieces, seen along the gap between them, in local coordinates: a stretch
/// or a convex area.
struct Overlap {
  Eigen::Vector3d middle_a;  ///< of the common stretch, or the centroid of the common area, on a
  Eigen::Vector3d middle_b;  ///< the same on b
  double size = 0;           ///< length or area
  Outline outline;
};

/// Whether two pieces of at least two points each (edges, folds, triangles) are parallel and overlap. Seen
/// along the gap between them, their relative interiors have a length or an area in common. Decided exactly.
/// `fold_side` of a triangle is the side (0-1, 1-2, 2-0) that is inside its face, 3 for none.
bool do_overlap(const Simplex& a, std::size_t fold_side_a, const Simplex& b, std::size_t fold_side_b,
                DecisionCount& count);

/// Returns the common part of two pieces that overlap. It is rounded.
Overlap overlap_of(const Simplex& a, const Simplex& b, const LocalFrame& frame, DecisionCount& count);

/// The overlaps of two features' pieces. Each feature has at most two pieces.
using Overlaps = InplaceVector<Overlap, 4>;

/// The largest connected part of the overlaps of two features' pieces (at least one), with its middle.
/// Rounded.
Overlap largest_part(const Overlaps& overlaps);

}  // namespace graze
