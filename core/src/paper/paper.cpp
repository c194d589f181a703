#include "paper/paper.hpp"

#include <algorithm>

#include "leaves/closest_vertices.hpp"
#include "leaves/leaf_vertex_pairs.hpp"
#include "pair/bounds.hpp"

namespace graze {
namespace {

FeaturePairKey middles_of(const Region& a, const Region& b) {
  return FeaturePairKey::of(vertex_piece(a.middle), vertex_piece(b.middle));
}

double epsilon_of(const SurfacePair& pair, const PairQuery& query, const Region& a, const Region& b) {
  if (query.epsilon.empty()) return pair.a.level_radii()[a.level] + pair.b.level_radii()[b.level];
  const std::size_t level = std::max<std::size_t>(1, std::max(a.level, b.level));
  const std::size_t last = std::max<std::size_t>(1, query.epsilon.size() - 1);
  return query.epsilon[std::min(level, last) - 1];
}

/// The range of a search for pairs of vertices nearer than the threshold.
struct VerticesBelow {
  double threshold;

  [[nodiscard]] double limit() const { return threshold; }
  [[nodiscard]] bool keep(double lower) const { return lower < threshold; }
  void left_out(double /*limit*/) const {}
};

class Paper {
 public:
  Paper(const SurfacePair& pair, const PairQuery& query, PaperScratch& scratch, WorkMeter& meter,
        std::vector<FeaturePairKey>& keys)
      : pair_(pair),
        query_(query),
        scratch_(scratch),
        meter_(meter),
        keys_(keys),
        bounds_(pair.a, pair.b, RefitOf::vertices),
        nearest_(pair, Ties::lowest, scratch.closest) {}

  PaperFound run() {
    scratch_.closest.clear();
    if (pair_.groups != nullptr) offer_some(*pair_.groups);
    scratch_.dmv.front.assign(1, RegionPair{});
    found_.complete = dmv(
        pair_.a.mesh().regions(), pair_.b.mesh().regions(), false, scratch_.dmv, meter_,
        [&](const RegionPair& regions, const Region& a, const Region& b) {
          const bool both = expand(regions, a, b);
          return Expansion{both, both};
        },
        [](const RegionPair&) { return true; },
        [&](const RegionPair& leaves, const Region& a, const Region& b) {
          dv({a, pair_.a.vertex_boxes()[leaves.a]}, {b, pair_.b.vertex_boxes()[leaves.b]});
        });
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    return found_;
  }

 private:
  /// Offers two vertices that may be tested, since DV may meet none.
  void offer_some(const FeatureFilter& groups) {
    if (const auto some = groups.some_vertices(pair_.a.mesh(), pair_.b.mesh()))
      nearest_.offer(FeaturePairKey::of(vertex_piece((*some)[0]), vertex_piece((*some)[1])));
  }
  /// Eq. 4: expand when the middle vertices are closer than the level's epsilon. The pair of roots is always
  /// expanded.
  bool expand(const RegionPair& regions, const Region& a, const Region& b) {
    if (std::max(a.level, b.level) == 0) return true;
    if (pair_.may_vertices(a.middle, b.middle)) nearest_.offer(middles_of(a, b));
    if (passes_as_in_paper(pair_, query_, a, b)) return true;
    found_.lower = std::min(found_.lower, bounds_.lower_with_spheres(regions));
    return false;
  }

  /// DV at two leaves: from their closest vertices (eq. 5) along the meshes' edges while the distance
  /// shrinks.
  void dv(const LeafOf& leaf_a, const LeafOf& leaf_b) {
    ++meter_.counters().leaf_pairs_tested;
    const auto closest = closest_vertices(pair_, leaf_a, leaf_b, scratch_.leaves, scratch_.leaf_closest);
    if (!closest) return;
    FeaturePairKey key = *closest;
    nearest_.offer(key);
    found_.lower = std::min(found_.lower, lower_distance(pair_.a.position(key.a().feature.index),
                                                         pair_.b.position(key.b().feature.index)));
    if (query_.detail == ContactDetail::vertices) return add_close_vertices(leaf_a, leaf_b);
    while (step_to_neighbour(key)) {
    }
    nearest_.offer(key);
    if (is_closer_than(pair_, key, query_.threshold)) keys_.push_back(key);
  }

  void add_close_vertices(const LeafOf& leaf_a, const LeafOf& leaf_b) {
    const VerticesBelow range{query_.threshold};
    for_each_vertex_pair(pair_, leaf_a, leaf_b, scratch_.leaves, range,
                         [&](std::uint32_t a, std::uint32_t b) {
                           if (!pair_.may_vertices(a, b)) return;
                           const auto key = FeaturePairKey::of(vertex_piece(a), vertex_piece(b));
                           if (is_closer_than(pair_, key, query_.threshold)) keys_.push_back(key);
                         });
  }

  /// Moves both ends to the nearest of their neighbours and themselves. Returns false where nothing is
  /// nearer.
  bool step_to_neighbour(FeaturePairKey& key) {
    scratch_.leaf_closest.clear();
    ClosestSet around(pair_, Ties::lowest, scratch_.leaf_closest);
    around.offer(key);
    const std::uint32_t a = key.a().feature.index;
    const std::uint32_t b = key.b().feature.index;
    const auto offer = [&](std::uint32_t to_a, std::uint32_t to_b) {
      if (pair_.may_vertices(to_a, to_b) &&
          lower_distance(pair_.a.position(to_a), pair_.b.position(to_b)) <= around.upper())
        around.offer(FeaturePairKey::of(vertex_piece(to_a), vertex_piece(to_b)));
    };
    for (const std::uint32_t to_a : pair_.a.mesh().vertex_neighbours(a)) {
      offer(to_a, b);
      for (const std::uint32_t to_b : pair_.b.mesh().vertex_neighbours(b)) offer(to_a, to_b);
    }
    for (const std::uint32_t to_b : pair_.b.mesh().vertex_neighbours(b)) offer(a, to_b);
    const FeaturePairKey nearest = around.front();
    if (compare_distances(pair_, nearest, key) >= 0) return false;
    key = nearest;
    return true;
  }

  const SurfacePair& pair_;
  const PairQuery& query_;
  PaperScratch& scratch_;
  WorkMeter& meter_;
  std::vector<FeaturePairKey>& keys_;
  RegionBounds bounds_;
  ClosestSet nearest_;
  PaperFound found_;
};

}  // namespace

bool passes_as_in_paper(const SurfacePair& pair, const PairQuery& query, const Region& a, const Region& b) {
  return is_closer_than(pair, middles_of(a, b), epsilon_of(pair, query, a, b));
}

PaperFound find_as_in_paper(const SurfacePair& pair, const PairQuery& query, PaperScratch& scratch,
                            WorkMeter& meter, std::vector<FeaturePairKey>& keys) {
  return Paper(pair, query, scratch, meter, keys).run();
}

}  // namespace graze
