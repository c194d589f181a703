#pragma once

#include <cstdint>

#include "closest_features/feature_pair_key.hpp"

namespace graze {

/// Whether two edges are locally closest, whose closest points lie inside both: on no triangle beside either
/// edge does the way from its point, square to the edge, lead nearer to the other point. Edges that cross are
/// locally closest.
bool are_locally_closest(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b);

}  // namespace graze
