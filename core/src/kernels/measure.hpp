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

struct NormalBatch {
  Points corner[3];
  // What the kernel fills in.
  Points normal;                ///< the unit normals of the triangles
  double error[contact_lanes];  ///< of them at most; infinite where double is not good enough
};

/// How many edges of a fan are walked at once.
inline constexpr std::size_t fan_edges = 16;

/// Fans of triangles, each about a vertex, as the edges from it to those around it: each triangle is between
/// an edge and the next. An edge of 0 is none, and no triangle has it.
struct FanBatch {
  float edge[fan_edges][3][contact_lanes];
  std::size_t edges;  ///< of the longest fan; the others go on with edges of 0
  // What the kernel fills in.
  float normal[3][contact_lanes];  ///< the unit normals, each by its triangle's angle at the vertex
  float error[contact_lanes];      ///< of that at most; infinite where float is not good enough
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
  void (*fans)(FanBatch& batch);
};

/// The kernels in use, chosen once; see graze/instruction_set.hpp.
const Measure& measure();

}  // namespace graze::kernels
