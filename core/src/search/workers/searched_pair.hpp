#pragma once

#include <cstddef>

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_query.hpp"
#include "core/surface/surface.hpp"
#include "measure/measure.hpp"

namespace graze {

/// The least `PairQuery::front_limit` with which a search keeps fronts and near lists.
inline constexpr std::size_t least_limit = 16;

/// The pair of surfaces that a search is about, the query, and where the answer goes. The pointers are valid
/// until the search has ended.
struct SearchedPair {
  const Surface* a = nullptr;
  const Surface* b = nullptr;
  PairQuery query;
  LeafFront* front = nullptr;
  PairAnswer* answer = nullptr;

  /// How many of the closest contacts the query's limit keeps; 0: all. They are chosen while a search finds
  /// them.
  [[nodiscard]] std::size_t closest_kept() const {
    return query.detail == ContactDetail::nearest ? 0 : query.contact_limit;
  }
  /// How many of the deepest contacts the query's limit keeps; 0: all. They are chosen once all have been
  /// measured.
  [[nodiscard]] std::size_t deepest_kept() const {
    return query.detail == ContactDetail::nearest ? query.contact_limit : 0;
  }
};

/// Writes the distance and the witness into an answer, whose nearest points are those of a key.
inline void set_distance(PairAnswer& answer, const SurfacePair& pair, const FeaturePairKey& nearest) {
  answer.distance = rounded_distance(pair, nearest);
  answer.witness = witness_of(measure_without_sides(pair, nearest));
}

}  // namespace graze
