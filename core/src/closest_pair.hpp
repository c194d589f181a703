#pragma once

#include <graze/pair_query.hpp>
#include <vector>

#include "closest_set.hpp"
#include "leaf_names.hpp"
#include "leaf_pairs.hpp"

namespace graze {

struct ClosestScratch {
  LeafScratch features;
  std::vector<ContactName> names;
};

/// What a search for the closest points found.
struct ClosestFound {
  bool complete = true;  ///< false: the budget ran out, and the rest means nothing
  bool pierced = false;  ///< an edge pierces a face
  /// Nothing was left out that is nearer than this, but for the names found.
  double lower = std::numeric_limits<double>::infinity();
};

/// The closest points of two surfaces or of their vertices, as `query.detail` is about the one or the other:
/// `scratch.names` holds the names at the least distance, all or the lowest. What is certainly not below the
/// reach is not looked at, and in AccuracyMode::within nothing that is neither below the threshold nor more
/// than the tolerance nearer than what is known; middle vertices are known from the start, so there is always
/// a name unless all is beyond reach.
ClosestFound find_closest(const SurfacePair& pair, const PairQuery& query, Ties ties, LeafPairs& leaf_pairs,
                          ClosestScratch& scratch, WorkMeter& meter);

}  // namespace graze
