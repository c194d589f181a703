#include "leaves/touching_features.hpp"

#include "leaves/below_threshold.hpp"
#include "leaves/leaf_feature_pairs.hpp"

namespace graze {
namespace {

/// The range of a query for what touches alone.
struct Touching : BelowThreshold<false> {
  [[nodiscard]] bool is_superfluous(const FeaturePairKey& /*lowest*/) const {
    return touching_edges->pierced;
  }
};

}  // namespace

void TouchingFeatures::add(const LeafOf& leaf_a, const LeafOf& leaf_b) {
  with_pairs([&](auto& range, auto& pairs) {
    if (scratch_.select_near(pair_, leaf_a, leaf_b, range)) pairs.add_selected_piercings();
  });
}

void TouchingFeatures::finish() {
  with_pairs([](auto& /*range*/, auto& pairs) { pairs.finish(); });
}

/// Calls `use` with the range and with what gives pairs of features to it.
template <typename Use>
void TouchingFeatures::with_pairs(const Use& use) {
  const NearListing no_listing;
  Touching range{{0, no_listing, &touching_}};
  const auto sink = [&](const FeaturePairKey& key, const SquaredRange& /*squared*/) {
    touching_.pierced = touching_.pierced || is_edge_through_face(key);
  };
  LeafFeaturePairs pairs(pair_, scratch_, range, sink);
  use(range, pairs);
}

}  // namespace graze
