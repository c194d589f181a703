#pragma once

#include "closest_features/feature_pair_key.hpp"
#include "leaves/leaf_features.hpp"
#include "leaves/leaf_scratch.hpp"
#include "leaves/touching_edges.hpp"

namespace graze {

/// Finds the edges of either surface that may touch a face of the other, between pairs of leaves, and whether
/// one pierces it. Float answers nearly all of it: once one edge pierces, no other is decided.
class TouchingFeatures {
 public:
  /// All edges are in `touching` after `finish`.
  TouchingFeatures(const SurfacePair& pair, LeafScratch& scratch, TouchingEdges& touching)
      : pair_(pair), scratch_(scratch), touching_(touching) {}

  void add(const LeafOf& leaf_a, const LeafOf& leaf_b);
  void finish();

 private:
  template <typename Use>
  void with_pairs(const Use& use);

  const SurfacePair& pair_;
  LeafScratch& scratch_;
  TouchingEdges& touching_;
};

}  // namespace graze
