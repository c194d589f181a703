#pragma once

#include <optional>

#include "closest_features/closest_set.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "leaves/leaf_feature_pairs.hpp"

namespace graze {

/// The closest pair of vertices of two leaves (eq. 5), ties to the lowest a, then b. There is none if the
/// groups leave no two vertices of theirs to be tested. `closest` is overwritten.
std::optional<FeaturePairKey> closest_vertices(const SurfacePair& pair, const LeafOf& leaf_a,
                                               const LeafOf& leaf_b, LeafScratch& scratch, Closest& closest);

}  // namespace graze
