#pragma once

#include "kernels/points.hpp"

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
  // Filled in by the kernels.
  Points low_point;
  Points high_point;
  Points normal;  ///< from low to high
  double distance[contact_lanes];
  double certain[contact_lanes];  ///< 1, or 0 where double is not good enough, and the rest means nothing
};

struct NormalBatch {
  Points corner[3];
  // Filled in by the kernel.
  Points normal;                ///< the unit normals of the triangles
  double error[contact_lanes];  ///< of them at most. It is infinite where double is not good enough
};

/// A weighted normal, of any length, and how far off it is at most: infinite where that is not known.
struct RoughNormal {
  double sum[3];
  double error;
};

/// A fan of triangles about a vertex: each triangle is between two points in a row.
template <typename Number>
struct Fan {
  PointArray<Number> points;
  std::uint32_t vertex;
  const std::uint32_t* around;
  std::size_t count;    ///< of these, one at least
  RoughNormal* normal;  ///< filled in: the triangles' unit normals, each by its angle at the vertex
};

/// A batch of fans. Kernels read the fans behind the last, up to a multiple of 4, too.
template <typename Number>
struct FanBatch {
  Fan<Number> fan[contact_lanes];
  std::size_t count;
  std::size_t longest;  ///< of their counts
};

/// How many contacts of vertices are measured in one call, at most: a multiple of 4.
inline constexpr std::size_t vertices_at_once = 128;

/// Contacts of vertices, of which there are rows up to a multiple of 4.
struct VertexBatch {
  std::size_t count;
  double a[vertices_at_once][4];  ///< points. The fourth is nothing
  double b[vertices_at_once][4];
  const RoughNormal* normal_a[vertices_at_once];
  const RoughNormal* normal_b[vertices_at_once];
  // Filled in by the kernel.
  double normal[vertices_at_once][4];  ///< from a to b, and the distance
  /// 0 where double is not good enough for normal and distance, which then mean nothing. Otherwise 1, plus 4
  /// times the side of a's normal, plus 16 times that of b's. A side is 1 for front, 2 for back, and 0 where
  /// it is not certain.
  double found[vertices_at_once];
};

/// The kernels of one instruction set. All lanes are worked on, whatever is in them.
struct Measure {
  using Kernel = void (*)(ContactBatch& batch);
  Kernel point_and_line;
  Kernel point_and_plane;
  Kernel lines;
  Kernel piercing;  ///< the distance is 0, the normal minus the triangle's
  void (*normals)(NormalBatch& batch);
  void (*vertices)(VertexBatch& batch);
  void (*fans_of_floats)(const FanBatch<float>& batch);
  void (*fans_of_doubles)(const FanBatch<double>& batch);
};

/// The kernels in use, chosen once, see graze/instruction_set.hpp.
const Measure& measure();

}  // namespace graze::kernels
