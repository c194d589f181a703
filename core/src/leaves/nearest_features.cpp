#include "leaves/nearest_features.hpp"

#include "closest_features/locally_closest.hpp"
#include "leaves/below_threshold.hpp"
#include "leaves/leaf_feature_pairs.hpp"

namespace graze {

void NearestFeatures::add(const LeafOf& leaf_a, const LeafOf& leaf_b) {
  BelowThreshold<true> range{threshold_, listing_};
  if (scratch_.select_near(pair_, leaf_a, leaf_b, range)) with_names([](auto& keys) { keys.add_selected(); });
}

void NearestFeatures::add_listed(std::span<const FeaturePair> listed) {
  with_names([&](auto& keys) { keys.add_listed(listed); });
}

void NearestFeatures::finish() {
  with_names([](auto& keys) { keys.finish(); });
}

/// Calls `use` with what gives the keys to `take`.
template <typename Use>
void NearestFeatures::with_names(const Use& use) {
  BelowThreshold<true> range{threshold_, listing_};
  const auto sink = [&](const FeaturePairKey& key, const SquaredRange& squared) { take(key, squared); };
  LeafFeaturePairs keys(pair_, scratch_, range, sink);
  use(keys);
}

/// A point of one surface at a vertex of the other is offered to both vertices if it is one.
void NearestFeatures::take(const FeaturePairKey& key, const SquaredRange& squared) {
  const FeatureKind kind_a = key.a().feature.kind;
  const FeatureKind kind_b = key.b().feature.kind;
  if (kind_a == FeatureKind::vertex)
    vertices_.offer(pair_, {VertexOfPair::of_a(key.index_a()), key, squared});
  if (kind_b == FeatureKind::vertex)
    vertices_.offer(pair_, {VertexOfPair::of_b(key.index_b()), key, squared});
  if (kind_a == FeatureKind::vertex || kind_b == FeatureKind::vertex) return;
  if (is_edge_through_face(key) ||
      (key.kind() == ContactKind::EE && is_closer_than(pair_, key, squared, threshold_) &&
       are_locally_closest(pair_, key.index_a(), key.index_b())))
    keys_.push_back(key);
}

void append_below(const SurfacePair& pair, std::span<const VertexNearest> nearest, double threshold,
                  std::vector<FeaturePairKey>& keys) {
  for (const VertexNearest& vertex : nearest) {
    pair.check_time();
    if (is_closer_than(pair, vertex.key, vertex.squared, threshold)) keys.push_back(vertex.key);
  }
}

}  // namespace graze
