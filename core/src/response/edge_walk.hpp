#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "response/closest_points.hpp"
#include "response/surface_walk.hpp"

namespace graze {

/// Whether two edges with closest points inside both are locally closest, in plain double: no corner across
/// from either edge leads nearer. It is the rule of `nearest` for edges that are apart.
bool are_locally_closest(const PlacedMesh& a, std::uint32_t edge_a, const PlacedMesh& b, std::uint32_t edge_b,
                         const ClosestPoints& at);

/// Whether two edges are both creases, and the way from a to b lies in the normal cones of both. For sunk
/// edges the way is the opposite one.
bool bound_patch(const PlacedMesh& a, std::uint32_t edge_a, const PlacedMesh& b, std::uint32_t edge_b,
                 const ClosestPoints& at, bool are_sunk);

/// A walk over two surfaces takes no more steps than this. One takes about half a microsecond.
inline constexpr unsigned most_steps_together = 8;

/// A walk over two surfaces to where they are locally closest.
struct PairWalk {
  WalkedPoint a;
  WalkedPoint b;
  unsigned steps = 0;
  bool has_arrived = false;
};

/// Walks from the closest points of two edges to where the surfaces are locally closest: where no triangle
/// that shares a vertex with the simplex of a point is nearer to the other point. Two triangles are convex,
/// so this holds for the two points together. The distance decreases with each step. The walk does not arrive
/// where the surfaces pass through each other, nor after most_steps_together.
PairWalk walk_together(const PlacedMesh& a, std::uint32_t edge_a, const PlacedMesh& b, std::uint32_t edge_b,
                       const ClosestPoints& at);

}  // namespace graze
