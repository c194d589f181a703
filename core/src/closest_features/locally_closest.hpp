#pragma once

#include <cstdint>

#include "closest_features/feature_pair_key.hpp"

namespace graze {

/// Whether two edges are locally closest, whose closest points lie inside both: on no triangle beside either
/// edge does the way from its point, square to the edge, lead nearer to the other point. Edges that cross are
/// locally closest. A triangle counts only if its face may be looked at with the other edge.
bool are_locally_closest(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b);

}  // namespace graze
