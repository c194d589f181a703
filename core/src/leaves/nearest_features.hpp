#pragma once

#include <optional>
#include <span>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/near_list.hpp"
#include "leaves/leaf_scratch.hpp"
#include "leaves/nearest_of_vertices.hpp"
#include "leaves/touching_edges.hpp"
#include "pair/near_listing.hpp"

namespace graze {

/// Finds the keys of `ContactDetail::nearest` between leaves of two surfaces. Edges that pierce faces, and
/// edges that are locally closest below a threshold, are appended to `keys`. What may be nearest to a vertex
/// is offered to `vertices`, which are complete when all leaves have been added. The fold of a quad and what
/// is nearest to it are a contact only where there is no other. `fold` takes the nearest of those below the
/// threshold.
class NearestFeatures {
 public:
  /// All keys have come after `finish`. So have the edges that touch in `touching`, which may be null.
  NearestFeatures(const SurfacePair& pair, double threshold, LeafScratch& scratch,
                  NearestOfVertices& vertices, std::optional<NearKey>& fold,
                  std::vector<FeaturePairKey>& keys, const NearListing& listing = {},
                  TouchingEdges* touching = nullptr)
      : pair_(pair),
        threshold_(threshold),
        scratch_(scratch),
        vertices_(vertices),
        fold_(fold),
        keys_(keys),
        listing_(listing),
        touching_(touching) {}

  void add(const LeafOf& leaf_a, const LeafOf& leaf_b);
  /// Features that were listed, in the frame of the scratch.
  void add_listed(std::span<const FeaturePair> listed);
  /// Sets the threshold for pairs that are added from here on.
  void set_threshold(double threshold) { threshold_ = threshold; }
  void finish();

 private:
  template <typename Use>
  void with_names(const Use& use);
  void take(const FeaturePairKey& key, const SquaredRange& squared);
  void take_near(const FeaturePairKey& key, const SquaredRange& squared);

  const SurfacePair& pair_;
  double threshold_;
  LeafScratch& scratch_;
  NearestOfVertices& vertices_;
  std::optional<NearKey>& fold_;
  std::vector<FeaturePairKey>& keys_;
  NearListing listing_;
  TouchingEdges* touching_;
};

/// Appends the keys of those vertices that are nearer than a threshold.
void append_below(const SurfacePair& pair, std::span<const VertexNearest> nearest, double threshold,
                  std::vector<FeaturePairKey>& keys);

}  // namespace graze
