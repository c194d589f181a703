#pragma once

#include "points.hpp"

/// Kernels that measure several contacts or triangles at once. They are compiled once for each instruction
/// set, so this header has no inline function that another translation unit might share with them. Those of
/// contacts do what measure.cpp does in Ball arithmetic, operation by operation, so that their results are
/// the same bits.
namespace graze::kernels {

/// Pairs of simplices of the same sizes, `low` with at most as many corners as `high`, and their closest
/// points, which are inside both, or where a segment pierces a triangle.
struct ContactBatch {
  Points low[2];
  Points high[3];
  // What the kernels fill in.
  Points low_point;
  Points high_point;
  Points normal;  ///< from low to high
  double distance[contact_lanes];
  double certain[contact_lanes];  ///< 1, or 0 where double is not good enough, and the rest means nothing
};

/// Triangles that are parts of weighted normals.
struct NormalBatch {
  Points corner[3];
  double weight[contact_lanes];  ///< or 0 where it is the angle at the first corner; the kernel puts in what
                                 ///< it took, or infinity where double is not good enough
  Points part;                   ///< filled in: the unit normal by its weight
};

/// The kernels of one instruction set. All lanes are worked on, whatever is in them.
struct Measure {
  using Kernel = void (*)(ContactBatch& batch);
  Kernel points;
  Kernel point_and_line;
  Kernel point_and_plane;
  Kernel lines;
  Kernel piercing;  ///< the distance is 0, the normal minus the triangle's
  void (*normals)(NormalBatch& batch);
};

/// The kernels in use, chosen once; see graze/instruction_set.hpp.
const Measure& measure();

}  // namespace graze::kernels
