#pragma once

#include <span>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/near_list.hpp"
#include "leaves/leaf_feature_pairs.hpp"
#include "leaves/piercing_edges.hpp"
#include "leaves/touching_edges.hpp"
#include "pair/near_listing.hpp"

namespace graze {

/// Finds the keys of `ContactDetail::features` between leaves of two surfaces: all contacts strictly closer
/// than a threshold and every edge that pierces a face. A key may be met in several pairs of leaves.
class CloseFeatures {
 public:
  /// Keys are appended to `keys`, and edges that pierce to `piercing`. All are there after `finish`. So are
  /// the edges that touch in `touching`, which may be null.
  CloseFeatures(const SurfacePair& pair, double threshold, LeafScratch& scratch,
                std::vector<FeaturePairKey>& keys, PiercingEdges& piercing, const NearListing& listing = {},
                TouchingEdges* touching = nullptr)
      : pair_(pair),
        threshold_(threshold),
        scratch_(scratch),
        keys_(keys),
        piercing_(piercing),
        listing_(listing),
        touching_(touching) {}

  void add(const LeafOf& leaf_a, const LeafOf& leaf_b);
  /// Sets the threshold for pairs that are added from here on, after `finish`.
  void set_threshold(double threshold) { threshold_ = threshold; }
  /// The features that the scratch has taken, whatever they are of.
  void add_selected();
  /// Features that were listed, in the frame of the scratch.
  void add_listed(std::span<const FeaturePair> listed);
  void finish();

 private:
  template <typename Use>
  void with_names(const Use& use);
  [[nodiscard]] bool is_contact(const FeaturePairKey& key, const SquaredRange& squared) const;
  void add_if_contact(const FeaturePairKey& key, const SquaredRange& squared);

  const SurfacePair& pair_;
  double threshold_;
  LeafScratch& scratch_;
  std::vector<FeaturePairKey>& keys_;
  PiercingEdges& piercing_;
  NearListing listing_;
  TouchingEdges* touching_;
};

/// Keeps one of sorted keys for each pair of features. Where two features meet in several pieces (a fold and
/// a triangle, two crossings), the closest stands for them. A piercing sorts first, and of equally close ones
/// the first counts. Returns how many there are then, the first of the keys.
[[nodiscard]] std::size_t keep_nearest_of_each(const SurfacePair& pair, std::span<FeaturePairKey> keys);

}  // namespace graze
