#include "closest_pair.hpp"

#include <algorithm>
#include <tuple>

namespace graze {
namespace {

/// Branch and bound over DMV: every region pair gives an upper bound, by its middle vertices, and a lower
/// one.
class Search {
 public:
  Search(const SurfacePair& pair, const PairQuery& query, Ties ties, ClosestScratch& scratch,
         WorkMeter& meter)
      : pair_(pair),
        query_(query),
        scratch_(scratch),
        meter_(meter),
        about_vertices_(is_about_vertices(query.detail)),
        set_(pair, ties, scratch.names) {}

  ClosestFound run() {
    scratch_.leaves.clear();
    offer_middles({});
    found_.complete = walk() && evaluate_leaves();
    found_.pierced = set_.pierced();
    return found_;
  }

 private:
  bool walk() {
    return dmv(
        pair_.a.mesh().regions(), pair_.b.mesh().regions(), scratch_.dmv, meter_,
        [&](const RegionPair& regions, const Region&, const Region&) {
          offer_middles(regions);
          return keep(lower(regions));
        },
        [&](const RegionPair& regions, const Region&, const Region&) {
          offer_middles(regions);
          scratch_.leaves.push_back({lower(regions), regions});
        });
  }

  bool evaluate_leaves() {
    std::sort(scratch_.leaves.begin(), scratch_.leaves.end(),
              [](const LeafPair& left, const LeafPair& right) {
                return std::tie(left.lower, left.pair.a, left.pair.b) <
                       std::tie(right.lower, right.pair.a, right.pair.b);
              });
    for (const LeafPair& leaves : scratch_.leaves) {
      if (!keep(leaves.lower)) continue;
      if (!meter_.spend()) return false;
      ++meter_.counters().leaf_pairs_tested;
      about_vertices_ ? offer_vertices(leaves.pair) : offer_features(leaves.pair);
    }
    return true;
  }

  /// Whether something this near could still matter; what is left out bounds the answer from below.
  bool keep(double lower_bound) {
    if (lower_bound > set_.upper()) return false;
    const bool below_reach = lower_bound < query_.reach || lower_bound == 0;
    const bool loose = query_.mode == AccuracyMode::within && lower_bound >= query_.threshold &&
                       lower_bound > 0 && lower_bound >= set_.upper() - query_.tolerance;
    if (below_reach && !loose) return true;
    found_.lower = std::min(found_.lower, lower_bound);
    return false;
  }

  [[nodiscard]] double lower(const RegionPair& regions) const {
    if (!about_vertices_)
      return lower_distance(pair_.a.face_boxes()[regions.a], pair_.b.face_boxes()[regions.b]);
    return vertex_lower_distance(pair_.a, pair_.b, regions);
  }

  void offer_middles(const RegionPair& regions) {
    const std::uint32_t a = pair_.a.mesh().regions().region(regions.a).middle;
    const std::uint32_t b = pair_.b.mesh().regions().region(regions.b).middle;
    if (upper_distance(pair_.a.position(a), pair_.b.position(b)) < set_.upper())
      set_.offer(ContactName::of(vertex_piece(a), vertex_piece(b)));
  }

  void offer_features(const RegionPair& leaves) {
    for_each_name(
        pair_, pair_.a.mesh().regions().region(leaves.a), pair_.a.face_boxes()[leaves.a],
        pair_.b.mesh().regions().region(leaves.b), pair_.b.face_boxes()[leaves.b], scratch_.features,
        [&](double lower_bound) { return keep(lower_bound); },
        [&](const ContactName& name) { set_.offer(name); });
  }

  void offer_vertices(const RegionPair& leaves) {
    const RegionTree& tree_a = pair_.a.mesh().regions();
    const RegionTree& tree_b = pair_.b.mesh().regions();
    for (const std::uint32_t a : tree_a.vertices(tree_a.region(leaves.a)))
      for (const std::uint32_t b : tree_b.vertices(tree_b.region(leaves.b)))
        if (keep(lower_distance(pair_.a.position(a), pair_.b.position(b))))
          set_.offer(ContactName::of(vertex_piece(a), vertex_piece(b)));
  }

  const SurfacePair& pair_;
  const PairQuery& query_;
  ClosestScratch& scratch_;
  WorkMeter& meter_;
  bool about_vertices_;
  ClosestSet set_;
  ClosestFound found_;
};

}  // namespace

ClosestFound find_closest(const SurfacePair& pair, const PairQuery& query, Ties ties, ClosestScratch& scratch,
                          WorkMeter& meter) {
  return Search(pair, query, ties, scratch, meter).run();
}

}  // namespace graze
