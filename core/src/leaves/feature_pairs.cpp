#include "leaves/feature_pairs.hpp"

namespace graze {
namespace {

/// The range of a query for contacts: pairs below the threshold, and piercing at every threshold. Pairs that
/// come to be so within the slack are listed.
struct BelowThreshold {
  double threshold;
  const NearListing& listing;

  [[nodiscard]] double limit() const { return threshold + listing.slack; }
  [[nodiscard]] double keys_only_below() const { return threshold; }
  [[nodiscard]] static bool may_pierce() { return true; }
  [[nodiscard]] double touching() const { return listing.slack; }
  [[nodiscard]] bool is_listing() const { return listing.is_wanted(); }
  void found(const FeatureRef& a, const FeatureRef& b) const { listing.add(a, b); }
  [[nodiscard]] bool keep(double lower) const { return lower < limit() || lower == 0; }
  void left_out(double /*limit*/) const {}
};

}  // namespace

bool CloseFeatures::is_contact(const FeaturePairKey& key, const SquaredRange& squared) const {
  if (key.meeting() == Meeting::pierced && key.kind() == ContactKind::EF) return true;
  if (squared.is_below(threshold_)) return true;
  return !squared.is_beyond(threshold_) && is_closer_than(pair_, key, threshold_);
}

void CloseFeatures::add_if_contact(const FeaturePairKey& key, const SquaredRange& squared) {
  pair_.check_time();
  if (!is_contact(key, squared)) return;
  std::uint32_t& slot = scratch_.recent_keys.slot(key);
  if (slot < keys_.size() && keys_[slot] == key) return;
  slot = static_cast<std::uint32_t>(keys_.size());
  keys_.push_back(key);
}

void CloseFeatures::add(const LeafOf& leaf_a, const LeafOf& leaf_b) {
  BelowThreshold range{threshold_, listing_};
  if (scratch_.select_near(pair_, leaf_a, leaf_b, range)) add_selected();
}

void CloseFeatures::add_selected() {
  with_names([](auto& keys) { keys.add_selected(); });
}

void CloseFeatures::add_listed(std::span<const FeaturePair> listed) {
  with_names([&](auto& keys) { keys.add_listed(listed); });
}

void CloseFeatures::finish() {
  with_names([](auto& keys) { keys.finish(); });
}

/// Calls `use` with what gives the keys to `take`.
template <typename Use>
void CloseFeatures::with_names(const Use& use) {
  BelowThreshold range{threshold_, listing_};
  const auto sink = [&](const FeaturePairKey& key, const SquaredRange& squared) {
    add_if_contact(key, squared);
  };
  LeafFeaturePairs keys(pair_, scratch_, range, sink);
  use(keys);
}

std::size_t keep_nearest_of_each(const SurfacePair& pair, std::span<FeaturePairKey> keys) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    pair.check_time();
    if (kept == 0 || !keys[kept - 1].same_features(keys[i]))
      keys[kept++] = keys[i];
    else if (keys[i] != keys[i - 1] && compare_distances(pair, keys[i], keys[kept - 1]) < 0)
      keys[kept - 1] = keys[i];
  }
  return kept;
}

}  // namespace graze
