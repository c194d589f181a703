#pragma once

#include "kernels/points.hpp"

/// Kernels that say of several pairs of features at once where their closest points lie, as far as plain
/// double is certain of it. They ask what certain.cpp asks, with its bounds (docs/numerics.md). They are
/// compiled once for each instruction set, so this header has no inline function that another translation
/// unit might share with them.
namespace graze::kernels {

/// The result for each pair. Where it is not certain, the other numbers mean nothing.
struct VoronoiFound {
  double certain[contact_lanes];  ///< 1 or 0
  double low[contact_lanes];      ///< the square of the distance is between these
  double high[contact_lanes];
};

/// Pairs of segments. The closest points are one pair, and inside neither a common stretch.
struct SegmentPairBatch {
  Points a[2];
  Points b[2];
  // Filled in by the kernel.
  double along_a[contact_lanes];  ///< a number of `Along`
  double along_b[contact_lanes];
  VoronoiFound found;
};

/// Points and triangles.
struct PointTriangleBatch {
  Points point;
  Points corner[3];
  // Filled in by the kernel.
  double voronoi[contact_lanes];  ///< a number of `VoronoiRegion`
  VoronoiFound found;
};

/// The kernels of one instruction set. All lanes are worked on, whatever is in them.
struct VoronoiKernels {
  void (*segments)(SegmentPairBatch& batch);
  void (*points_and_triangles)(PointTriangleBatch& batch);
};

/// The kernels in use, chosen once, see graze/instruction_set.hpp.
const VoronoiKernels& voronoi();

}  // namespace graze::kernels
