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

/// Whether a key is of an edge that pierces a face with which it is tested.
bool TouchingFeatures::is_piercing(const FeaturePairKey& key) const {
  if (!is_edge_through_face(key)) return false;
  if (groups_ == nullptr) return true;
  const auto ref_of = [](const FeaturePiece& piece) {
    const bool is_edge = piece.feature.kind == FeatureKind::edge;
    return FeatureRef{is_edge ? FeatureRefKind::edge : FeatureRefKind::face, piece.feature.index};
  };
  return groups_->may(ref_of(key.a()), ref_of(key.b()));
}

/// Calls `use` with the range and with what gives pairs of features to it.
template <typename Use>
void TouchingFeatures::with_pairs(const Use& use) {
  const NearListing no_listing;
  Touching range{{0, no_listing, &touching_}};
  const auto sink = [&](const FeaturePairKey& key, const SquaredRange& /*squared*/) {
    touching_.pierced = touching_.pierced || is_piercing(key);
  };
  LeafFeaturePairs pairs(pair_, scratch_, range, sink);
  use(range, pairs);
}

}  // namespace graze
