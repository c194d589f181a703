#pragma once

#include "closest_features/feature_pair_key.hpp"
#include "leaves/layout/leaf_features.hpp"
#include "leaves/leaf_scratch.hpp"
#include "leaves/touching_edges.hpp"

namespace graze {

/// Finds the edges of either surface that may touch a face of the other, between pairs of leaves. Groups of
/// faces play no part in that. It also finds whether an edge pierces a face that it is tested with. Float
/// answers nearly all of it: once one edge pierces, no other is decided.
class TouchingFeatures {
 public:
  /// All edges are in `touching` after `finish`. `pair` has no groups, and `groups` are those that say what
  /// is tested, or null.
  TouchingFeatures(const SurfacePair& pair, const FeatureFilter* groups, LeafScratch& scratch,
                   TouchingEdges& touching)
      : pair_(pair), groups_(groups), scratch_(scratch), touching_(touching) {}

  void add(const LeafOf& leaf_a, const LeafOf& leaf_b);
  void finish();

 private:
  template <typename Use>
  void with_pairs(const Use& use);
  [[nodiscard]] bool is_piercing(const FeaturePairKey& key) const;

  const SurfacePair& pair_;
  const FeatureFilter* groups_;
  LeafScratch& scratch_;
  TouchingEdges& touching_;
};

}  // namespace graze
