#pragma once

#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/near_list.hpp"
#include "leaves/layout/leaf_features.hpp"
#include "leaves/leaf_scratch.hpp"

namespace graze {

/// Finds the edges and diagonals of either surface with the faces of the other that they pierce, or that they
/// may come to pierce when the surfaces move by a distance. It finds others that are near as well. All
/// diagonals of quads count, also those of flat ones.
class NearPiercings {
 public:
  /// Pairs are appended to `found`, some of them several times. All are there after `finish`.
  NearPiercings(const SurfacePair& pair, double distance, LeafScratch& scratch,
                std::vector<FeaturePair>& found)
      : pair_(pair), distance_(distance), scratch_(scratch), found_(found) {}

  void add(const LeafOf& leaf_a, const LeafOf& leaf_b);
  void finish();

 private:
  template <typename Use>
  void with_pairs(const Use& use);

  const SurfacePair& pair_;
  double distance_;
  LeafScratch& scratch_;
  std::vector<FeaturePair>& found_;
};

}  // namespace graze
