#pragma once

#include <optional>
#include <span>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/near_list.hpp"
#include "leaves/leaf_scratch.hpp"
#include "leaves/nearest_of_vertices.hpp"
#include "leaves/piercing_edges.hpp"
#include "leaves/touching_edges.hpp"
#include "pair/near_listing.hpp"

namespace graze {

/// Two edges that are a contact only if they are sunk, or only if they are not.
struct EdgesIfSunk {
  FeaturePairKey key;
  bool if_sunk = false;
};

/// The lists that NearestFeatures fills.
struct NearestFound {
  std::vector<FeaturePairKey>& keys;        ///< edges that pierce faces, and edges below the threshold
  std::vector<EdgesIfSunk>& edges_if_sunk;  ///< further edges below the threshold
  PiercingEdges& piercing;                  ///< the edges that pierce
  /// The nearest where one feature is the fold of a quad, or one edge a seam of hidden faces, of those below
  /// the threshold. It is a contact only where there is no other. For a surface and itself it is the nearest
  /// of all that is no contact.
  std::optional<NearKey>& fold;
  /// The features that may be nearest to each vertex. It is complete when all leaves have been added.
  NearestOfVertices& vertices;
};

/// Finds the keys of `ContactDetail::nearest` between leaves of two surfaces.
class NearestFeatures {
 public:
  /// All has been found after `finish`. So have the edges that touch in `touching`, which may be null.
  NearestFeatures(const SurfacePair& pair, double threshold, LeafScratch& scratch, const NearestFound& found,
                  const NearListing& listing = {}, TouchingEdges* touching = nullptr)
      : pair_(pair),
        threshold_(threshold),
        scratch_(scratch),
        found_(found),
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
  template <typename Range, typename Use>
  void with_names_in(Range range, const Use& use);
  void take(const FeaturePairKey& key, const SquaredRange& squared);
  void take_vertices_of_self(const FeaturePairKey& key, const SquaredRange& squared);
  void take_near(const FeaturePairKey& key);
  void take_edges(const FeaturePairKey& key);
  void take_alone(const FeaturePairKey& key);

  const SurfacePair& pair_;
  double threshold_;
  LeafScratch& scratch_;
  NearestFound found_;
  NearListing listing_;
  TouchingEdges* touching_;
};

/// Appends the keys of those vertices that are nearer than a threshold.
void append_below(const SurfacePair& pair, std::span<const VertexNearest> nearest, double threshold,
                  std::vector<FeaturePairKey>& keys);

}  // namespace graze
