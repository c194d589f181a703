// This part of a pair's search finds a point where surfaces that touched still do.

#include <algorithm>

#include "search/pair_search.hpp"
#include "search/pair_search_worker.hpp"
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

TouchingOrder PairSearch::touching_order() const {
  return {a_->mesh().regions(), b_->mesh().regions()};
}

/// Sorts the front by the order in which leaf pairs are tested for touching.
void PairSearch::sort_front() {
  std::sort(front_->leaves.begin(), front_->leaves.end(), touching_order());
}

/// Searches for distance 0 and nothing else, in the cheapest way that there is.
void PairSearch::find_touching(Worker& worker) {
  closest_.closest.upper = 0;
  is_bounded_ = true;
  if (from_front_) return test_front(worker);
  front_->reached_bits < least_reached_bits ? approach(worker) : walk_touching(worker);
}

/// One leaf pair of the front after the other, until one touches; nothing is to be sorted for it. Of a large
/// pair not all by one thread, if they touch no more.
void PairSearch::test_front(Worker& worker) {
  ClosestRange range(worker.pair, query_, ties(), closest_);
  validate(*front_, *a_, *b_);
  const double motion = front_->motion_now(*a_, *b_);
  if (!front_->leaves.empty()) worker.begin_leaves(front_->leaves.front().pair);
  std::size_t asked = 0;
  for (const ListedLeaves& listed : front_->leaves) {
    if (range.is_decided()) break;
    LeafPair leaves{0, listed.pair};
    if (static_cast<double>(listed.lower) > motion || worker.leaf_pairs.lower_of_leaves(leaves.pair) > 0)
      continue;
    if (sliced_ && ++asked > touching_first) {
      closest_.clear();  // a name at 0 might not be the first of them
      break;
    }
    if (!test_leaves(leaves, range, worker)) return give_up();
  }
  finish_closest(worker);
}

/// Finds touching leaves without a front: takes one leaf of a surface after the other, each with the leaves
/// of the other surface whose boxes overlap its own. Where the surfaces touch in many points this soon meets
/// one, and no front is made. The order is that of a front, so it finds the same point. If it meets none, a
/// front is worth its walk.
void PairSearch::walk_touching(Worker& worker) {
  const TouchingOrder order = touching_order();
  const RegionTree& scattered = (order.scatters_a() ? a_ : b_)->mesh().regions();
  const std::uint64_t end = worker.meter.counters().region_pairs_tested + tests_in_turn(*front_);
  ClosestRange range(worker.pair, query_, ties(), closest_);
  const auto goes_on = [&] {
    return !range.is_decided() && worker.meter.counters().region_pairs_tested < end;
  };
  for (std::uint32_t slot = 0; slot < order.slot_count() && goes_on(); ++slot) {
    const std::uint32_t region = order.region_at(slot);
    if (region >= order.region_count() || !scattered.region(region).is_leaf()) continue;
    if (!test_overlapping(order.with_all(region), order, range, worker)) return give_up();
  }
  if (!range.is_decided()) {
    closest_.clear();  // a name at 0 might not be the first of them
    closest_.closest.upper = 0;
    return approach(worker);
  }
  set_apart();
  stage_ = Stage::done;
  report_closest(worker);
}

/// Tests the pairs of leaves below `start` whose boxes overlap, in order, until one touches; false when the
/// budget ran out.
bool PairSearch::test_overlapping(const RegionPair& start, const TouchingOrder& order, ClosestRange& range,
                                  Worker& worker) {
  auto& leaves = found_.leaves;
  leaves.clear();
  const auto overlaps = [](double lower, double /*slack*/) { return lower == 0; };
  if (!worker.leaf_pairs.walk(
          {&start, 1}, overlaps, [](const RegionPair&) {}, found_))
    return false;
  std::erase_if(leaves, [](const LeafPair& each) { return each.lower > 0; });
  std::sort(leaves.begin(), leaves.end(), order);
  worker.begin_leaves(found_);
  for (LeafPair& each : leaves) {
    if (range.is_decided()) break;
    if (!test_leaves(each, range, worker)) return false;
  }
  return true;
}

}  // namespace graze
