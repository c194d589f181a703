#pragma once

#include <cstdint>

#include "closest_features/feature_pair_key.hpp"

namespace graze {

/// Whether `ContactDetail::nearest` lists two edges. That two edges are sunk is known only when all edges
/// that pierce have been found.
enum class EdgesListed : std::uint8_t {
  never,
  only_alone,  ///< if there is no other contact, so that surfaces in contact are known to be
  if_not_sunk,
  if_sunk,
  always,
};

/// Whether two edges are listed whose closest points lie inside both.
///
/// They are if they are locally closest: on no triangle beside either edge does the way from its point,
/// square to the edge, lead nearer to the other point. Edges that cross are locally closest. An edge that is
/// no crease does not count where both its triangles lie square to the way between the points.
///
/// They are, too, if both are creases and the way u from a to b is close to the normal cones. That is so if
/// no triangle beside the edge of a leads along u by more than τ = 10.2°, and none beside the edge of b along
/// −u. Where the edges are sunk, u is the opposite. A triangle counts only if the groups of its face let it
/// be tested with the other edge. Of one surface with itself a triangle counts even if it is a neighbour of
/// the other edge.
///
/// At a seam the seen face goes on behind the edge. So a seam is no crease, and two edges of which one is a
/// seam are listed only where they cross. If they are locally closest but for that, they are listed alone.
/// Where several faces of an edge are seen, these alone say whether it is a crease.
EdgesListed listed_edges(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b);

}  // namespace graze
