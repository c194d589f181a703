#pragma once

#include <optional>

#include "closest_features/feature_pair_key.hpp"
#include "leaves/nearest_of_vertices.hpp"

namespace graze {

/// Finds what is nearest to a vertex of one surface on the other one, however far. Of equally near ones it is
/// the lowest. There is nothing if no face may be looked at with the vertex. The other surface has been
/// refitted for faces. `last` is what was found for another vertex. It saves time where that vertex is near.
std::optional<VertexNearest> nearest_on_surface(const SurfacePair& pair, VertexOfPair vertex,
                                                const std::optional<VertexNearest>& last);

}  // namespace graze
