#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/working_memory.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/mesh/region_tree.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "pair/region_expansion.hpp"
#include "pair/time_limit.hpp"

namespace graze {

/// The fronts that DMV steps through. They are kept from pair to pair so that their memory is.
struct DmvScratch {
  std::vector<RegionPair> front;
  std::vector<RegionPair> next;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.front, self.next);
  }
  void reserve_as(const DmvScratch& other) { reserve_swapped_as(front, next, other.front, other.next); }
  void reserve(const PairRoom& room) {
    // Only some of the pairs of a level are near.
    constexpr std::size_t tested_for_one = 16;
    front.reserve(tested_for_one * room.leaf_pairs);
    next.reserve(tested_for_one * room.leaf_pairs);
  }
};

/// How much of a query's budget is left, counted in region pairs tested.
class WorkMeter {
 public:
  /// `time` is null where there is no deadline.
  WorkMeter(const PairQuery& query, PairCounters& counters, TimeLimit* time)
      : counters_(counters),
        limit_(query.work_limit > ~std::uint64_t{0} - counters.region_pairs_tested
                   ? ~std::uint64_t{0}
                   : counters.region_pairs_tested + query.work_limit),
        time_(time) {}

  /// Counts one region pair. Returns false when the budget is spent. Throws TimeIsUp.
  bool spend() {
    if (counters_.region_pairs_tested >= limit_) return false;
    ++counters_.region_pairs_tested;
    if (time_ != nullptr) time_->check();
    return true;
  }
  PairCounters& counters() { return counters_; }

 private:
  PairCounters& counters_;
  std::uint64_t limit_;
  TimeLimit* time_;
};

/// DMV (paper, figure 3): walks the pairs of regions of two trees breadth first, from those in
/// `scratch.front`. It stops where a level has more than `most` pairs, and leaves these there. Returns false
/// when the budget ran out on the way.
///
/// `expand(pair, a, b)` says which regions of a pair to expand, of which at least one is no leaf. Neither
/// ends the walk there. A leaf is never expanded. If `is_of_self`, the trees are of one surface. A region and
/// itself is then always expanded on both sides, and each two of its children make one pair. Where both are,
/// a child that `may_meet` finds to be far from the whole of the other region is left out. `leaves(pair, a,
/// b)` takes each pair of leaves that is reached.
template <typename Expand, typename MayMeet, typename Leaves>
bool dmv(const RegionTree& tree_a, const RegionTree& tree_b, bool is_of_self, DmvScratch& scratch,
         WorkMeter& meter, const Expand& expand, const MayMeet& may_meet, const Leaves& leaves,
         std::size_t most = std::numeric_limits<std::size_t>::max()) {
  const auto push_children = [&](const RegionPair& pair, const Region& a, const Region& b,
                                 const Expansion& expansion) {
    const auto push = [&](const RegionPair& child) { scratch.next.push_back(child); };
    if (is_of_self && pair.a == pair.b) return visit_with_itself(a, push);
    const RegionChildren children(pair, a, b, expansion);
    if (children.count_a == 1 || children.count_b == 1) return children.visit(push);
    std::array<std::uint32_t, 8> near_b;
    std::size_t near_count = 0;
    for (std::uint32_t j = 0; j < children.count_b; ++j)
      if (may_meet({pair.a, children.first_b + j})) near_b[near_count++] = children.first_b + j;
    for (std::uint32_t i = 0; i < children.count_a && near_count > 0; ++i) {
      if (!may_meet({children.first_a + i, pair.b})) continue;
      for (std::size_t j = 0; j < near_count; ++j) push({children.first_a + i, near_b[j]});
    }
  };
  while (!scratch.front.empty() && scratch.front.size() <= most) {
    scratch.next.clear();
    for (const RegionPair& pair : scratch.front) {
      const Region& a = tree_a.region(pair.a);
      const Region& b = tree_b.region(pair.b);
      if (!meter.spend()) return false;
      if (a.is_leaf() && b.is_leaf()) {
        leaves(pair, a, b);
      } else if (const Expansion expansion = expand(pair, a, b); expansion.a || expansion.b) {
        ++meter.counters().regions_expanded[std::max(a.level, b.level)];
        push_children(pair, a, b, expansion);
      }
    }
    std::swap(scratch.front, scratch.next);
  }
  return true;
}

}  // namespace graze
