#pragma once

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/near_list.hpp"
#include "leaves/touching_edges.hpp"
#include "pair/near_listing.hpp"

namespace graze {

/// The range of a query for contacts: pairs below the threshold, and piercing at every threshold. Pairs that
/// come to be so within the slack are listed. `nearest`: of each vertex the nearest is wanted alone.
/// `inner_edges`: two edges are of interest only if their closest points are inside both.
template <bool nearest, bool inner_edges = nearest>
struct BelowThreshold {
  static constexpr bool nearest_only = nearest;
  static constexpr bool inner_edges_only = inner_edges;
  static constexpr bool may_settle = false;

  double threshold;
  const NearListing& listing;
  TouchingEdges* touching_edges;  ///< null where nobody asks

  [[nodiscard]] double limit() const { return threshold + listing.slack; }
  [[nodiscard]] double keys_only_below() const { return threshold; }
  [[nodiscard]] static bool may_pierce() { return true; }
  [[nodiscard]] double touching() const { return listing.slack; }
  [[nodiscard]] bool is_listing() const { return listing.is_wanted(); }
  void found(const FeatureRef& a, const FeatureRef& b) const { listing.add(a, b); }
  [[nodiscard]] bool collects_touching() const { return touching_edges != nullptr; }
  void may_touch(const FeatureRef& segment, bool is_of_a) const {
    if (touching_edges != nullptr) touching_edges->add(segment, is_of_a);
  }
  [[nodiscard]] static bool wants_touching() { return false; }
  [[nodiscard]] static bool is_superfluous(const FeaturePairKey& /*lowest*/) { return false; }
  [[nodiscard]] bool keep(double lower) const { return lower < limit() || lower == 0; }
  void left_out(double /*limit*/) const {}
};

}  // namespace graze
