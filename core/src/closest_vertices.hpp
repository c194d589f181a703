#pragma once

#include "closest_set.hpp"
#include "contact_name.hpp"
#include "leaf_names.hpp"

namespace graze {

/// The closest pair of vertices of two leaves (eq. 5), ties to the lowest a, then b. `closest` is
/// overwritten.
ContactName closest_vertices(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b,
                             LeafScratch& scratch, Closest& closest);

}  // namespace graze
