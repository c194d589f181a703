#pragma once

#include "leaves/leaf_names.hpp"
#include "names/closest_set.hpp"
#include "names/contact_name.hpp"

namespace graze {

/// The closest pair of vertices of two leaves (eq. 5), ties to the lowest a, then b. `closest` is
/// overwritten.
ContactName closest_vertices(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b,
                             LeafScratch& scratch, Closest& closest);

}  // namespace graze
