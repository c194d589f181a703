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

/// Calls `use` with what gives the keys to `take`. Between two surfaces an end of an edge is tested with the
/// faces of the other edge. Of one surface it may not be, and then two edges alone tell their distance.
template <typename Use>
void NearestFeatures::with_names(const Use& use) {
  pair_.is_of_self() ? with_names_in(BelowThreshold<true, false>{threshold_, listing_, touching_}, use)
                     : with_names_in(BelowThreshold<true>{threshold_, listing_, touching_}, use);
}

template <typename Range, typename Use>
void NearestFeatures::with_names_in(Range range, const Use& use) {
  const auto sink = [&](const FeaturePairKey& key, const SquaredRange& squared) {
    take(in_order(pair_, key), squared);
  };
  LeafFeaturePairs keys(pair_, scratch_, range, sink);
  use(keys);
}

/// A point of one surface at a vertex of the other is offered to both vertices if it is one.
void NearestFeatures::take(const FeaturePairKey& key, const SquaredRange& squared) {
  const FeatureKind kind_a = key.a().feature.kind;
  const FeatureKind kind_b = key.b().feature.kind;
  if (kind_a == FeatureKind::vertex || kind_b == FeatureKind::vertex) {
    if (pair_.is_of_self()) return take_vertices_of_self(key, squared);
    if (kind_a == FeatureKind::vertex)
      found_.vertices.offer(pair_, {{key, squared}, VertexOfPair::of_a(key.index_a())});
    if (kind_b == FeatureKind::vertex)
      found_.vertices.offer(pair_, {{key, squared}, VertexOfPair::of_b(key.index_b())});
    return;
  }
  if (is_edge_through_face(key)) {
    if (touching_ != nullptr) touching_->pierced = true;
    found_.piercing.add(key);
    found_.keys.push_back(key);
  } else if (is_closer_than(pair_, key, squared, threshold_)) {
    take_near(key);
  }
}

/// A vertex of one surface with itself is one vertex, in whichever order it is met. Two edges may be tested
/// whose closest points are at a vertex that is tested with no face there. It tells the distance alone.
void NearestFeatures::take_vertices_of_self(const FeaturePairKey& key, const SquaredRange& squared) {
  // Float does not say how near edges are.
  const SquaredRange range = squared.high > 0 ? squared : SquaredRange();
  bool is_offered = false;
  const auto offer = [&](const Feature& vertex, const Feature& other) {
    if (vertex.kind != FeatureKind::vertex || !pair_.groups->may_vertex(vertex.index, other)) return;
    found_.vertices.offer(pair_, {{key, range}, VertexOfPair::of_a(vertex.index)});
    is_offered = true;
  };
  offer(key.a().feature, key.b().feature);
  offer(key.b().feature, key.a().feature);
  if (!is_offered && is_closer_than(pair_, key, squared, threshold_)) take_alone(key);
}

/// Takes two edges, or features of which one is a fold, that are below the threshold.
void NearestFeatures::take_near(const FeaturePairKey& key) {
  if (key.kind() == ContactKind::EE)
    take_edges(key);
  else
    take_alone(key);
}

/// Takes two features that are a contact only where there is no other.
void NearestFeatures::take_alone(const FeaturePairKey& key) {
  // Float does not say how near edges are, so no range is known.
  if (found_.fold)
    keep_nearer(pair_, *found_.fold, {key, {}});
  else
    found_.fold = {key, {}};
}

void NearestFeatures::take_edges(const FeaturePairKey& key) {
  const EdgesListed listed = listed_edges(pair_, key.index_a(), key.index_b());
  // A face that leads nearer may be a neighbour of the other edge. So these edges may tell the distance.
  if (pair_.is_of_self() && listed != EdgesListed::always) take_alone(key);
  switch (listed) {
    case EdgesListed::never:
      break;
    case EdgesListed::only_alone:
      take_alone(key);
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
