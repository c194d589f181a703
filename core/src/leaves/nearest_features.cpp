#include "leaves/nearest_features.hpp"

#include "closest_features/listed_edges.hpp"
#include "leaves/below_threshold.hpp"
#include "leaves/leaf_feature_pairs.hpp"

namespace graze {

void NearestFeatures::add(const LeafOf& leaf_a, const LeafOf& leaf_b) {
  BelowThreshold<true> range{threshold_, listing_, touching_};
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
  BelowThreshold<true> range{threshold_, listing_, touching_};
  const auto sink = [&](const FeaturePairKey& key, const SquaredRange& squared) { take(key, squared); };
  LeafFeaturePairs keys(pair_, scratch_, range, sink);
  use(keys);
}

/// A point of one surface at a vertex of the other is offered to both vertices if it is one.
void NearestFeatures::take(const FeaturePairKey& key, const SquaredRange& squared) {
  const FeatureKind kind_a = key.a().feature.kind;
  const FeatureKind kind_b = key.b().feature.kind;
  if (kind_a == FeatureKind::vertex)
    found_.vertices.offer(pair_, {{key, squared}, VertexOfPair::of_a(key.index_a())});
  if (kind_b == FeatureKind::vertex)
    found_.vertices.offer(pair_, {{key, squared}, VertexOfPair::of_b(key.index_b())});
  if (kind_a == FeatureKind::vertex || kind_b == FeatureKind::vertex) return;
  if (is_edge_through_face(key)) {
    if (touching_ != nullptr) touching_->pierced = true;
    found_.piercing.add(key);
    found_.keys.push_back(key);
  } else if (is_closer_than(pair_, key, squared, threshold_)) {
    take_near(key, squared);
  }
}

/// Takes two edges, or features of which one is a fold, that are below the threshold.
void NearestFeatures::take_near(const FeaturePairKey& key, const SquaredRange& squared) {
  if (key.kind() == ContactKind::EE)
    take_edges(key, squared);
  else
    take_alone(key, squared);
}

/// Takes two features that are a contact only where there is no other.
void NearestFeatures::take_alone(const FeaturePairKey& key, const SquaredRange& squared) {
  if (found_.fold)
    keep_nearer(pair_, *found_.fold, {key, squared});
  else
    found_.fold = {key, squared};
}

void NearestFeatures::take_edges(const FeaturePairKey& key, const SquaredRange& squared) {
  switch (listed_edges(pair_, key.index_a(), key.index_b())) {
    case EdgesListed::never:
      break;
    case EdgesListed::only_alone:
      take_alone(key, squared);
      break;
    case EdgesListed::always:
      found_.keys.push_back(key);
      break;
    case EdgesListed::if_sunk:
      found_.edges_if_sunk.push_back({key, true});
      break;
    case EdgesListed::if_not_sunk:
      found_.edges_if_sunk.push_back({key, false});
      break;
  }
}

void append_below(const SurfacePair& pair, std::span<const VertexNearest> nearest, double threshold,
                  std::vector<FeaturePairKey>& keys) {
  for (const VertexNearest& vertex : nearest) {
    pair.check_time();
    if (is_closer_than(pair, vertex.key, vertex.squared, threshold)) keys.push_back(vertex.key);
  }
}

}  // namespace graze
