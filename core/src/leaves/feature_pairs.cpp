#include "leaves/feature_pairs.hpp"

#include "leaves/below_threshold.hpp"

namespace graze {

bool CloseFeatures::is_contact(const FeaturePairKey& key, const SquaredRange& squared) const {
  return is_edge_through_face(key) || is_closer_than(pair_, key, squared, threshold_);
}

void CloseFeatures::add_if_contact(const FeaturePairKey& key, const SquaredRange& squared) {
  pair_.check_time();
  if (!is_contact(key, squared)) return;
  std::uint32_t& slot = scratch_.recent_keys.slot(key);
  if (slot < keys_.size() && keys_[slot] == key) return;
  slot = static_cast<std::uint32_t>(keys_.size());
  keys_.push_back(key);
  if (!is_edge_through_face(key)) return;
  piercing_.add(key);
  if (touching_ != nullptr) touching_->pierced = true;
}

void CloseFeatures::add(const LeafOf& leaf_a, const LeafOf& leaf_b) {
  BelowThreshold<false> range{threshold_, listing_, touching_};
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
  BelowThreshold<false> range{threshold_, listing_, touching_};
  const auto sink = [&](const FeaturePairKey& key, const SquaredRange& squared) {
    add_if_contact(in_order(pair_, key), squared);
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
