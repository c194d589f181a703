#pragma once

#include <cstdint>
#include <vector>

#include "models/models.hpp"

namespace graze::springs {

enum class SpringKind : std::uint8_t { structural, shear, bend };

/// Between two vertices, `a` below `b`, with no force at `rest_length`.
struct Spring {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  SpringKind kind = SpringKind::structural;
  double rest_length = 0;
  double stiffness = 0;  ///< force by stretch
};

struct Stiffness {
  double structural = 1;
  double shear = 1;
  double bend = 1;
};

/// The springs of a mesh at rest, each pair of vertices once (an edge before a diagonal before a bend):
/// structural along edges, shear along the diagonals of quads, and bend between the two vertices on either
/// side of an edge that lie one edge further from the same end of it (of two triangles, their opposite
/// corners). Sorted by kind, then by the vertices.
std::vector<Spring> springs_of(const models::MeshData& mesh, const Stiffness& stiffness);

}  // namespace graze::springs
