// This part of the search for the closest points finds a point where surfaces that touched still do.

#include <algorithm>

#include "search/closest/closest_search.hpp"
#include "walk/validate_front.hpp"

namespace graze {
namespace {

/// Leaf pairs of a large pair that one thread asks alone.
constexpr std::size_t touching_first = 4096;
/// A walk that reached fewer pairs of leaves, by the bits of their number, is as soon made anew.
constexpr std::uint8_t least_reached_bits = 8;

/// At most so many pairs of regions a search without a front tests: fewer than the last walk did, which
/// tested every pair of leaves that it reached.
std::uint64_t tests_in_turn(const LeafFront& front) {
  return std::uint64_t{1} << (front.reached_bits - 1U);
}

}  // namespace

TouchingOrder ClosestSearch::touching_order() const {
  return {pair_.a->mesh().regions(), pair_.b->mesh().regions()};
}

/// Sorts the front by the order in which leaf pairs are tested for touching.
void ClosestSearch::sort_front() {
  std::sort(pair_.front->leaves.begin(), pair_.front->leaves.end(), touching_order());
}

/// Searches for distance 0 and nothing else, in the cheapest way that there is.
SearchProgress ClosestSearch::begin_touching(SearchWorker& worker) {
  choose_source();
  closest_.clear();
  closest_.closest.upper = 0;
  is_bounded_ = true;
  if (source_ != LeafSource::walk) return test_front(worker);
  return pair_.front->reached_bits < least_reached_bits ? approach(worker) : walk_touching(worker);
}

/// Tests one leaf pair of the front after the other, until one touches. The front is in the order for that.
/// One thread does not test all leaf pairs of a large pair, since its surfaces may touch no more.
SearchProgress ClosestSearch::test_front(SearchWorker& worker) {
  ClosestRange range(worker.pair, pair_.query, ties(), closest_);
  if (pair_.query.groups == nullptr) validate(*pair_.front, *pair_.a, *pair_.b);
  const double motion = pair_.front->motion_now(*pair_.a, *pair_.b);
  if (!pair_.front->leaves.empty()) worker.begin_leaves(pair_.front->leaves.front().pair);
  std::size_t asked = 0;
  for (const ListedLeaves& listed : pair_.front->leaves) {
    if (range.is_decided()) break;
    LeafPair leaves{0, listed.pair};
    if (static_cast<double>(listed.lower) > motion || worker.leaf_pairs.lower_of_leaves(leaves.pair) > 0)
      continue;
    if (slices_.may_cut() && ++asked > touching_first) {
      closest_.clear();  // a name at 0 might not be the first of them
      break;
    }
    if (!test_leaves(leaves, range, worker)) return SearchProgress::gave_up;
  }
  return finish(worker);
}

/// Finds touching leaves without a front: takes one leaf of a surface after the other, each with the leaves
/// of the other surface whose boxes overlap its own. Where the surfaces touch in many points this soon meets
/// one, and no front is made. The order is that of a front, so it finds the same point. If it meets none, a
/// front is worth its walk.
SearchProgress ClosestSearch::walk_touching(SearchWorker& worker) {
  const TouchingOrder order = touching_order();
  const RegionTree& scattered = (order.scatters_a() ? pair_.a : pair_.b)->mesh().regions();
  const std::uint64_t end = worker.meter.counters().region_pairs_tested + tests_in_turn(*pair_.front);
  ClosestRange range(worker.pair, pair_.query, ties(), closest_);
  const auto goes_on = [&] {
    return !range.is_decided() && worker.meter.counters().region_pairs_tested < end;
  };
  for (std::uint32_t slot = 0; slot < order.slot_count() && goes_on(); ++slot) {
    const std::uint32_t region = order.region_at(slot);
    if (region >= order.region_count() || !scattered.region(region).is_leaf()) continue;
    if (!test_overlapping(order.with_all(region), order, range, worker)) return SearchProgress::gave_up;
  }
  if (!range.is_decided()) {
    closest_.clear();  // a name at 0 might not be the first of them
    closest_.closest.upper = 0;
    return approach(worker);
  }
  set_apart();
  return report(worker);
}

/// Tests the pairs of leaves below `start` whose boxes overlap, in order, until one touches; false when the
/// budget ran out.
bool ClosestSearch::test_overlapping(const RegionPair& start, const TouchingOrder& order, ClosestRange& range,
                                     SearchWorker& worker) {
  auto& leaves = slices_.found().leaves;
  leaves.clear();
  const auto overlaps = [](double lower, double /*slack*/) { return lower == 0; };
  if (!worker.leaf_pairs.walk(
          {&start, 1}, overlaps, [](const RegionPair&) {}, slices_.found()))
    return false;
  // Two leaves of one surface are tested with the leaf that is scattered of the two.
  const bool is_of_self = worker.pair.is_of_self();
  std::erase_if(
      leaves, [&](const LeafPair& each) { return each.lower > 0 || (is_of_self && each.pair.b != start.b); });
  std::sort(leaves.begin(), leaves.end(), order);
  worker.begin_leaves(slices_.found());
  for (LeafPair& each : leaves) {
    if (range.is_decided()) break;
    if (!test_leaves(each, range, worker)) return false;
  }
  return true;
}

}  // namespace graze
