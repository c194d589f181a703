#include "closest_pair.hpp"

#include <algorithm>
#include <tuple>

namespace graze {
namespace {

/// Branch and bound over the pairs of leaves: middle vertices give an upper bound, boxes a lower one.
class Search {
 public:
  Search(const SurfacePair& pair, const PairQuery& query, Ties ties, LeafPairs& leaf_pairs,
         ClosestScratch& scratch, WorkMeter& meter)
      : pair_(pair),
        query_(query),
        leaf_pairs_(leaf_pairs),
        scratch_(scratch),
        meter_(meter),
        about_vertices_(is_about_vertices(query.detail)),
        set_(pair, ties, scratch.names) {}

  ClosestFound run() {
    offer_middles({});
    if (leaf_pairs_.beyond_front() > 0) {
      leaf_pairs_.take_front();
      found_.complete = evaluate_leaves();
      // Settled, unless something outside the front may be as near as what is in it.
      if (!found_.complete || !keep(leaf_pairs_.beyond_front())) return found();
      found_ = {};
    }
    found_.complete = leaf_pairs_.walk([&](double lower, double slack) { return keep(lower, slack); },
                                       [&](const RegionPair& regions) { offer_middles(regions); }) &&
                      evaluate_leaves();
    if (found_.complete)
      leaf_pairs_.remember(std::max(query_.threshold, std::min(set_.upper(), query_.reach)));
    return found();
  }

  /// Whether something this near could still matter, now or before the surfaces have moved by `slack`; what
  /// is left out bounds the answer from below.
  bool keep(double lower_bound, double slack = 0) {
    const double nearest = std::max(0.0, lower_bound - slack);
    if (nearest > set_.upper()) return false;
    const bool below_reach = nearest < query_.reach || nearest == 0;
    const bool loose = query_.mode == AccuracyMode::within && nearest >= query_.threshold && nearest > 0 &&
                       nearest >= set_.upper() - query_.tolerance;
    if (below_reach && !loose) return true;
    found_.lower = std::min(found_.lower, lower_bound);
    return false;
  }

  /// What is certainly further than this does not matter now; in units of the scene.
  [[nodiscard]] double limit() const {
    const double reached = std::min(set_.upper(), query_.reach);
    if (query_.mode != AccuracyMode::within) return reached;
    return std::min(reached, std::max(query_.threshold, set_.upper() - query_.tolerance));
  }
  /// Something was left out that is further than an earlier or the present limit.
  void left_out(double limit) {
    if (limit < set_.upper()) found_.lower = std::min(found_.lower, limit);
  }

 private:
  ClosestFound found() {
    found_.pierced = set_.pierced();
    return found_;
  }

  bool evaluate_leaves() {
    std::sort(leaf_pairs_.found().begin(), leaf_pairs_.found().end(),
              [](const LeafPair& left, const LeafPair& right) {
                return std::tie(left.lower, left.pair.a, left.pair.b) <
                       std::tie(right.lower, right.pair.a, right.pair.b);
              });
    for (const LeafPair& leaves : leaf_pairs_.found()) {
      if (!keep(leaves.lower)) continue;
      if (!meter_.spend()) return false;
      ++meter_.counters().leaf_pairs_tested;
      about_vertices_ ? offer_vertices(leaves.pair) : offer_features(leaves.pair);
    }
    return true;
  }

  void offer_middles(const RegionPair& regions) {
    const std::uint32_t a = pair_.a.mesh().regions().region(regions.a).middle;
    const std::uint32_t b = pair_.b.mesh().regions().region(regions.b).middle;
    if (upper_distance(pair_.a.position(a), pair_.b.position(b)) < set_.upper())
      set_.offer(ContactName::of(vertex_piece(a), vertex_piece(b)));
  }

  void offer_features(const RegionPair& leaves) {
    for_each_name(pair_, leaf_a(leaves), leaf_b(leaves), scratch_.features, *this,
                  [&](const ContactName& name) { set_.offer(name); });
  }

  void offer_vertices(const RegionPair& leaves) {
    for_each_vertex_pair(pair_, leaf_a(leaves), leaf_b(leaves), scratch_.features, *this,
                         [&](std::uint32_t a, std::uint32_t b) {
                           set_.offer(ContactName::of(vertex_piece(a), vertex_piece(b)));
                         });
  }

  LeafOf leaf_a(const RegionPair& leaves) { return {leaf_pairs_.leaf_a(leaves), leaf_pairs_.box_a(leaves)}; }
  LeafOf leaf_b(const RegionPair& leaves) { return {leaf_pairs_.leaf_b(leaves), leaf_pairs_.box_b(leaves)}; }

  const SurfacePair& pair_;
  const PairQuery& query_;
  LeafPairs& leaf_pairs_;
  ClosestScratch& scratch_;
  WorkMeter& meter_;
  bool about_vertices_;
  ClosestSet set_;
  ClosestFound found_;
};

}  // namespace

ClosestFound find_closest(const SurfacePair& pair, const PairQuery& query, Ties ties, LeafPairs& leaf_pairs,
                          ClosestScratch& scratch, WorkMeter& meter) {
  return Search(pair, query, ties, leaf_pairs, scratch, meter).run();
}

}  // namespace graze
