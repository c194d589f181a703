#pragma once

#include <algorithm>
#include <graze/leaf_front.hpp>
#include <graze/pair_query.hpp>
#include <limits>
#include <span>
#include <vector>

#include "bounds.hpp"
#include "contact_name.hpp"
#include "dmv.hpp"
#include "leaf_boxes.hpp"
#include "validate.hpp"

namespace graze {

/// A pair of leaves that may be near, and at most how far apart they are.
struct LeafPair {
  double lower = 0;
  RegionPair pair;
};

struct LeafPairScratch {
  DmvScratch dmv;
  LeafBoxes boxes_a;
  LeafBoxes boxes_b;
  std::vector<LeafPair> found;
};

/// The pairs of leaves that one query looks into: those of the last query's front while that still covers
/// what is wanted, otherwise those that DMV reaches.
class LeafPairs {
 public:
  LeafPairs(const SurfacePair& pair, const PairQuery& query, LeafFront& front, LeafPairScratch& scratch,
            WorkMeter& meter)
      : pair_(pair),
        query_(query),
        front_(front),
        scratch_(scratch),
        meter_(meter),
        about_vertices_(is_about_vertices(query.detail)),
        bounds_(pair.a, pair.b, about_vertices_),
        beyond_front_(front.beyond_now(pair.a, pair.b)) {
    scratch_.boxes_a.begin(pair.a, about_vertices_);
    scratch_.boxes_b.begin(pair.b, about_vertices_);
  }

  /// No pair of leaves outside the front is nearer; not positive where there is no front.
  [[nodiscard]] double beyond_front() const { return beyond_front_; }

  /// Finds the leaf pairs of the front.
  void take_front() {
    if (!about_vertices_) validate(front_, pair_.a, pair_.b);
    scratch_.found.clear();
    for (const RegionPair& leaves : front_.leaves)
      scratch_.found.push_back({lower_of_leaves(leaves), leaves});
  }

  /// Finds the leaf pairs that DMV reaches while `keep(lower, slack)` holds: whether something that is at
  /// least `lower` apart may come to matter before the surfaces have moved by `slack`. `meet(pair)` is called
  /// for every pair of regions. False when the budget ran out.
  template <typename Keep, typename Meet>
  bool walk(const Keep& keep, const Meet& meet) {
    scratch_.found.clear();
    beyond_ = std::numeric_limits<double>::infinity();
    const auto keeps = [&](double lower) {
      if (keep(lower, query_.slack)) return true;
      beyond_ = std::min(beyond_, lower);
      return false;
    };
    return dmv(
        pair_.a.mesh().regions(), pair_.b.mesh().regions(), scratch_.dmv, meter_,
        [&](const RegionPair& regions, const Region& a, const Region& b) {
          meet(regions);
          return keeps(bounds_.lower(regions)) ? expansion_of(regions, a, b) : Expansion{};
        },
        [&](const RegionPair& leaves, const Region&, const Region&) {
          meet(leaves);
          const double lower = bounds_.lower(leaves);
          if (keeps(lower)) scratch_.found.push_back({std::max(lower, lower_of_leaves(leaves)), leaves});
        });
  }

  /// After a walk: makes its leaf pairs the front, but for those that do not matter before the surfaces have
  /// moved by the slack, where what is looked for is nearer than `wanted`.
  void remember(double wanted) {
    front_.forget();
    if (query_.slack <= 0) return;
    for (const LeafPair& leaves : scratch_.found) {
      if (leaves.lower <= wanted + query_.slack)
        front_.leaves.push_back(leaves.pair);
      else
        beyond_ = std::min(beyond_, leaves.lower);
    }
    if (front_.leaves.size() > query_.front_limit) return front_.forget();
    front_.beyond = beyond_;
    front_.travel_a = pair_.a.travel();
    front_.travel_b = pair_.b.travel();
  }

  /// Calls `visit(leaf pair)` for every pair of leaves that may be below the query's threshold, or at
  /// distance 0 where `touching` is set. False when the budget ran out.
  template <typename Visit>
  bool each_below_threshold(bool touching, const Visit& visit) {
    const auto keep = [&](double lower) { return lower < query_.threshold || (touching && lower == 0); };
    const bool from_front = beyond_front_ > query_.threshold;
    if (from_front)
      take_front();
    else if (!walk([&](double lower, double slack) { return keep(std::max(0.0, lower - slack)); },
                   [](const RegionPair&) {}))
      return false;
    for (const LeafPair& leaves : scratch_.found) {
      if (from_front && !meter_.spend()) return false;
      if (!keep(leaves.lower)) continue;
      ++meter_.counters().leaf_pairs_tested;
      visit(leaves.pair);
    }
    if (!from_front) remember(query_.threshold);
    return true;
  }

  [[nodiscard]] std::vector<LeafPair>& found() { return scratch_.found; }
  [[nodiscard]] const Box& box_a(const RegionPair& leaves) { return scratch_.boxes_a.of(leaves.a); }
  [[nodiscard]] const Box& box_b(const RegionPair& leaves) { return scratch_.boxes_b.of(leaves.b); }
  [[nodiscard]] const Region& leaf_a(const RegionPair& leaves) const {
    return pair_.a.mesh().regions().region(leaves.a);
  }
  [[nodiscard]] const Region& leaf_b(const RegionPair& leaves) const {
    return pair_.b.mesh().regions().region(leaves.b);
  }

 private:
  /// Of two regions of very different size the larger alone is expanded: of a pebble and a planet one way
  /// down the planet is walked, not one for each part of the pebble. Otherwise both are, as in the paper.
  [[nodiscard]] Expansion expansion_of(const RegionPair& regions, const Region& a, const Region& b) const {
    constexpr double very_different = 4;
    const double size_a = bounds_.size_a(regions);
    const double size_b = bounds_.size_b(regions);
    if (size_a > very_different * size_b && !a.is_leaf()) return {true, false};
    if (size_b > very_different * size_a && !b.is_leaf()) return {false, true};
    return {true, true};
  }
  double lower_of_leaves(const RegionPair& leaves) { return lower_distance(box_a(leaves), box_b(leaves)); }

  const SurfacePair& pair_;
  const PairQuery& query_;
  LeafFront& front_;
  LeafPairScratch& scratch_;
  WorkMeter& meter_;
  bool about_vertices_;
  RegionBounds bounds_;
  double beyond_front_;
  double beyond_ = 0;
};

}  // namespace graze
