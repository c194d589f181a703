#pragma once

#include <chrono>
#include <cstdint>
#include <graze/pair_query.hpp>
#include <graze/region_tree.hpp>
#include <utility>
#include <vector>

#include "region_pair.hpp"

namespace graze {

/// The fronts that DMV steps through; kept from pair to pair so that their memory is.
struct DmvScratch {
  std::vector<RegionPair> front;
  std::vector<RegionPair> next;
};

/// How much of a query's budget is left, counted in region pairs tested.
class WorkMeter {
 public:
  WorkMeter(const PairQuery& query, PairCounters& counters)
      : counters_(counters),
        limit_(query.work_limit > ~std::uint64_t{0} - counters.region_pairs_tested
                   ? ~std::uint64_t{0}
                   : counters.region_pairs_tested + query.work_limit),
        deadline_(query.deadline) {}

  /// Counts one region pair; false when the budget is spent.
  bool spend() {
    if (counters_.region_pairs_tested >= limit_) return false;
    ++counters_.region_pairs_tested;
    // The clock costs as much as some ten region pairs.
    constexpr std::uint64_t look_at_clock_every = 64;
    return deadline_ == PairQuery::no_deadline || counters_.region_pairs_tested % look_at_clock_every != 0 ||
           std::chrono::steady_clock::now() < deadline_;
  }
  PairCounters& counters() { return counters_; }

 private:
  PairCounters& counters_;
  std::uint64_t limit_;
  std::chrono::steady_clock::time_point deadline_;
};

/// DMV (paper, figure 3): walks the pairs of regions of two trees breadth first, level by level. Both regions
/// of a pair are expanded at once; where one is a leaf, only the other is. `expand(pair, a, b)` says whether
/// to go on from a pair of which at least one region is no leaf, and `leaves(pair, a, b)` takes each pair of
/// leaves that is reached. The pair of roots is expanded without a test, as in the paper. False when the
/// budget ran out on the way.
template <typename Expand, typename Leaves>
bool dmv(const RegionTree& tree_a, const RegionTree& tree_b, DmvScratch& scratch, WorkMeter& meter,
         const Expand& expand, const Leaves& leaves) {
  const auto push_children = [&](const RegionPair& pair, const Region& a, const Region& b) {
    const std::uint32_t first_a = a.is_leaf() ? pair.a : a.first_child;
    const std::uint32_t first_b = b.is_leaf() ? pair.b : b.first_child;
    const std::uint32_t count_a = a.is_leaf() ? 1 : a.child_count;
    const std::uint32_t count_b = b.is_leaf() ? 1 : b.child_count;
    for (std::uint32_t i = 0; i < count_a; ++i)
      for (std::uint32_t j = 0; j < count_b; ++j) scratch.next.push_back({first_a + i, first_b + j});
  };
  scratch.front.assign(1, RegionPair{});
  for (std::size_t level = 0; !scratch.front.empty(); ++level) {
    scratch.next.clear();
    for (const RegionPair& pair : scratch.front) {
      const Region& a = tree_a.region(pair.a);
      const Region& b = tree_b.region(pair.b);
      if (!meter.spend()) return false;
      if (a.is_leaf() && b.is_leaf()) {
        leaves(pair, a, b);
      } else if (level == 0 || expand(pair, a, b)) {
        ++meter.counters().regions_expanded[level];
        push_children(pair, a, b);
      }
    }
    std::swap(scratch.front, scratch.next);
  }
  return true;
}

}  // namespace graze
