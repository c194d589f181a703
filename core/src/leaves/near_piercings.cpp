#include "leaves/near_piercings.hpp"

#include "leaves/below_threshold.hpp"
#include "leaves/leaf_feature_pairs.hpp"

namespace graze {
namespace {

/// The range of a query that lists what is near and decides nothing.
struct NearOnly : BelowThreshold<false> {
  [[nodiscard]] static bool is_superfluous(const FeaturePairKey& /*lowest*/) { return true; }
};

}  // namespace

void NearPiercings::add(const LeafOf& leaf_a, const LeafOf& leaf_b) {
  with_pairs([&](auto& range, auto& pairs) {
    if (scratch_.select_near(pair_, leaf_a, leaf_b, range)) pairs.add_selected_piercings();
  });
}

void NearPiercings::finish() {
  with_pairs([](auto& /*range*/, auto& pairs) { pairs.finish(); });
}

/// Calls `use` with the range and with what gives pairs of features to it.
template <typename Use>
void NearPiercings::with_pairs(const Use& use) {
  const NearListing listing{&found_, distance_};
  NearOnly range{{0, listing, nullptr}};
  const auto sink = [](const FeaturePairKey& /*key*/, const SquaredRange& /*squared*/) {};
  LeafFeaturePairs pairs(pair_, scratch_, range, sink);
  use(range, pairs);
}

}  // namespace graze
