#include "search/closest/closest_search.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "measure/measure.hpp"
#include "measure/parallel.hpp"
#include "walk/last_witness.hpp"

namespace graze {
namespace {

constexpr std::size_t closest_first = 64;  ///< leaf pairs that make the bound tight before others are cut
constexpr std::size_t closest_each = 64;
constexpr std::size_t few_near = 256;  ///< pairs of leaves that no slabs are made for

/// Updates the bound of two listed leaves by the result of testing them now, after a motion since they were
/// listed.
void raise(ListedLeaves& listed, const LeafPair& now, double motion) {
  listed.feature_lower_bound =
      std::max(listed.feature_lower_bound,
               rounded_down((static_cast<double>(now.feature_lower_bound) + motion) * round_down));
}

/// Returns the first of some sorted keys at distance 0 whose edge pierces a face. At threshold 0 only that is
/// contact, since touching is not below the threshold.
const FeaturePairKey& lowest_piercing(const std::vector<FeaturePairKey>& keys) {
  return *std::find_if(keys.begin(), keys.end(), is_edge_through_face);
}

/// Puts the leaf pairs that are not further than a distance first, sorted by their lower bounds, and returns
/// how many they are. The others are not tested, and stay in no order.
std::size_t sort_near_first(std::vector<LeafPair>& leaves, double distance, const TouchingOrder& order) {
  const auto rest = std::partition(leaves.begin(), leaves.end(),
                                   [&](const LeafPair& each) { return each.lower <= distance; });
  std::sort(leaves.begin(), rest, [&](const LeafPair& left, const LeafPair& right) {
    return left.lower != right.lower ? left.lower < right.lower : order(left, right);
  });
  return static_cast<std::size_t>(rest - leaves.begin());
}

}  // namespace

SearchProgress ClosestSearch::begin(SearchWorker& worker) {
  pair_.answer->contacts.clear();
  has_touching_ = false;
  if (pair_.query.detail == ContactDetail::vertices) return begin_vertices(worker);
  pair_.front->walked = true;
  const bool may_touch = pair_.front->touched && ties() == Ties::lowest && !about_vertices();
  return may_touch ? begin_touching(worker) : begin_surfaces(worker);
}

SearchProgress ClosestSearch::next_stage(SearchWorker& worker) {
  return stage_ == Stage::approach ? begin_closest(worker) : finish(worker);
}

void ClosestSearch::run(SearchSlice& slice, SearchWorker& worker) {
  if (stage_ == Stage::approach) return run_approach(slice, worker);
  seed(slice);
  slice.complete = test_leaves(slice.begin, slice.end, slice.closest, worker);
}

void ClosestSearch::reserve_as(const ClosestSearch& other) {
  graze::reserve_as(closest_.closest, other.closest_.closest);
  graze::reserve_as(touching_, other.touching_);
}

void ClosestSearch::reserve(const PairRoom& room) {
  graze::reserve(closest_.closest, room);
}

std::size_t ClosestSearch::byte_count() const {
  return bytes_of(closest_.closest) + bytes_of(touching_);
}

/// ContactDetail::closest needs all keys at the least distance. The distance alone needs one.
Ties ClosestSearch::ties() const {
  return pair_.query.detail == ContactDetail::closest ? Ties::all : Ties::lowest;
}

/// Finds the closest vertices by blocks. It begins with the bounds by middle vertices and the last witness.
SearchProgress ClosestSearch::begin_vertices(SearchWorker& worker) {
  closest_.clear();
  ClosestRange range(worker.pair, pair_.query, Ties::lowest, closest_);
  range.offer_some();
  range.at_most(upper_distance(worker.pair, pair_.front->witness, true));
  NearVertices vertices(worker.pair, range.limit(), near_blocks_, worker.scratch.vertices);
  vertices.find_blocks();
  if (!vertices.offer(worker.meter, range)) return SearchProgress::gave_up;
  slices_.clear();
  return closest_.closest.keys.empty() ? answer_nothing() : report(worker);
}

SearchProgress ClosestSearch::begin_surfaces(SearchWorker& worker) {
  choose_source();
  closest_.clear();
  ClosestRange range(worker.pair, pair_.query, ties(), closest_);
  range.offer_some();
  const double of_roots = closest_.closest.upper;
  range.at_most(upper_distance(worker.pair, pair_.front->witness, about_vertices()));
  is_bounded_ = closest_.closest.upper < of_roots;
  return approach(worker);
}

/// Begins anew without what the last answer left, so that the search ends even where it finds nothing again.
SearchProgress ClosestSearch::walk_anew(SearchWorker& worker) {
  slices_.found().clear();
  source_ = LeafSource::walk;
  is_bounded_ = false;
  closest_.clear();
  ClosestRange(worker.pair, pair_.query, ties(), closest_).offer_some();
  return approach(worker);
}

/// Bounds from below the distance of all pairs of leaves that the front does not list. Not positive where
/// nothing is known.
double ClosestSearch::unlisted_lower_bound() const {
  return pair_.front->unlisted_lower_bound_now(*pair_.a, *pair_.b);
}

/// Chooses the front, if it bounds all pairs of leaves that it does not list.
void ClosestSearch::choose_source() {
  slices_.found().clear();
  source_ = LeafSource::walk;
  if (!(unlisted_lower_bound() > 0)) return;
  const double motion = pair_.front->motion_now(*pair_.a, *pair_.b);
  const bool are_apart = static_cast<double>(pair_.front->apart) > motion;
  source_ = are_apart ? LeafSource::front_if_apart : LeafSource::front;
}

/// Middle vertices are also points of the surfaces, and bound their distance where nothing better does.
auto ClosestSearch::offering_middles(ClosestRange& range) const {
  return [this, &range](const RegionPair& regions) {
    if (!is_bounded_) range.offer_middles(regions);
  };
}

/// Finds the pairs of leaves to test.
SearchProgress ClosestSearch::approach(SearchWorker& worker) {
  stage_ = Stage::approach;
  if (source_ != LeafSource::walk) {
    slices_.cut_front();
    return SearchProgress::slices;
  }
  ClosestRange range(worker.pair, pair_.query, ties(), closest_);
  slices_.walk(
      worker, [&](double lower, double slack) { return range.keep(lower, slack); }, offering_middles(range));
  return SearchProgress::slices;
}

/// A slice goes on from what was known when it was cut, not from what others find meanwhile.
void ClosestSearch::seed(SearchSlice& slice) const {
  slice.closest.clear();
  if (!closest_.closest.keys.empty()) slice.closest.closest.keys.assign(closest_.closest.keys.front());
  slice.closest.closest.upper = closest_.closest.upper;
}

void ClosestSearch::run_approach(SearchSlice& slice, SearchWorker& worker) {
  if (source_ != LeafSource::walk)
    return worker.leaf_pairs.select_from(*pair_.front, slice.begin, slice.end, closest_.closest.upper,
                                         source_ == LeafSource::front_if_apart, slice.found);
  if (slice.start.empty()) return;
  seed(slice);
  ClosestRange range(worker.pair, pair_.query, ties(), slice.closest);
  slice.complete = worker.leaf_pairs.walk(
      slice.start, [&](double lower, double slack) { return range.keep(lower, slack); },
      offering_middles(range), slice.found);
}

/// Takes the closest points of all slices, until these decide the answer.
void ClosestSearch::merge_slices(SearchWorker& worker) {
  ClosestSet set(worker.pair, ties(), closest_.closest);
  for (const SearchSlice& slice : slices_.all()) {
    if (set.is_decided(pair_.query.threshold)) break;
    for (const FeaturePairKey& key : slice.closest.closest.keys.keys()) set.offer(key);
    closest_.closest.pierced = closest_.closest.pierced || slice.closest.closest.pierced;
    closest_.lower = std::min(closest_.lower, slice.closest.lower);
    set.at_most(slice.closest.closest.upper);
  }
  set.merge_runs();
}

SearchProgress ClosestSearch::begin_closest(SearchWorker& worker) {
  slices_.gather_found();
  merge_slices(worker);
  slices_.clear();
  stage_ = Stage::closest;
  auto& leaves = slices_.found().leaves;
  const std::size_t near = sort_near_first(leaves, closest_.closest.upper, touching_order());
  are_many_near_ = near > few_near;
  const std::size_t first = slices_.may_cut() ? std::min(near, closest_first) : near;
  if (!test_leaves(0, first, closest_, worker)) return SearchProgress::gave_up;
  // Leaf pairs are kept or not by their lower bounds alone, which ascend.
  ClosestRange range(worker.pair, pair_.query, ties(), closest_);
  std::size_t end = first;
  while (end < near && !range.is_decided() && range.keep(leaves[end].lower)) ++end;
  slices_.add_range(first, end, closest_each);
  return SearchProgress::slices;
}

/// Tests a range of the leaf pairs found, as far as need be; false when the budget ran out.
///
/// Leaf pairs whose boxes overlap now are always these, in this order, whatever was known of earlier steps.
/// So a witness at distance 0 does not depend on those either.
bool ClosestSearch::test_leaves(std::size_t begin, std::size_t end, ClosestFound& found,
                                SearchWorker& worker) {
  worker.begin_leaves(slices_.found());
  worker.scratch.features.makes_slabs_of_far = are_many_near_;
  ClosestRange range(worker.pair, pair_.query, ties(), found, source_ != LeafSource::front_if_apart);
  for (std::size_t i = begin; i < end && !range.is_decided(); ++i) {
    LeafPair& leaves = slices_.found().leaves[i];
    if (!range.keep(leaves.lower)) continue;
    if (!test_leaves(leaves, range, worker)) return false;
  }
  return true;
}

/// Tests two leaves, and updates their bounds; false when the budget ran out.
bool ClosestSearch::test_leaves(LeafPair& leaves, ClosestRange& range, SearchWorker& worker) {
  if (!range.keep(worker.leaf_pairs.lower_by_corners(leaves.pair))) return true;
  if (!range.keep(worker.leaf_pairs.lower_since_rest(leaves.pair, 0))) return true;
  if (!worker.meter.spend()) return false;
  ++worker.meter.counters().leaf_pairs_tested;
  const LeafOf a = worker.leaf_pairs.leaf_a(leaves.pair);
  const LeafOf b = worker.leaf_pairs.leaf_b(leaves.pair);
  if (about_vertices()) {
    range.offer_vertices(a, b, worker.scratch.features);
    return true;
  }
  // Slices of large pairs run at the same time, and these have more than one pair of leaves. So no two slices
  // write the edges.
  const bool collects = range.may_pierce() && is_one_pair_of_leaves();
  if (collects) {
    touching_.clear();
    range.collect(touching_);
  }
  leaves.feature_lower_bound = rounded_down(range.offer_features(a, b, worker.scratch.features));
  if (collects) {
    touching_.pierced = range.has_pierced();
    has_touching_ = true;
  }
  return true;
}

/// Whether a test of one pair of leaves finds all edges that touch, of a pair that has a solid.
bool ClosestSearch::is_one_pair_of_leaves() const {
  return pair_.query.has_solid() && pair_.query.groups == nullptr &&
         pair_.a->mesh().regions().region_count() == 1 && pair_.b->mesh().regions().region_count() == 1;
}

/// Answers, unless the closest points may be where the search has not looked. Then it walks anew.
SearchProgress ClosestSearch::finish(SearchWorker& worker) {
  merge_slices(worker);
  slices_.clear();
  if (closest_.closest.keys.empty()) {
    if (source_ != LeafSource::walk || is_bounded_) return walk_anew(worker);
    // The whole of both surfaces was walked without a bound, and the reach is less than what underflow loses.
    // To begin anew would find nothing again.
    if (!ClosestRange(worker.pair, pair_.query, ties(), closest_).offer_any()) return find_nothing(worker);
  }
  if (source_ == LeafSource::walk) {
    slices_.keep_front(std::max(pair_.query.threshold, std::min(closest_.closest.upper, pair_.query.reach)),
                       worker);
  } else if (ClosestRange(worker.pair, pair_.query, ties(), closest_).keep(unlisted_lower_bound())) {
    // Something outside the front may be as near as the nearest in it.
    source_ = LeafSource::walk;
    closest_.lower = std::numeric_limits<double>::infinity();
    return approach(worker);
  } else {
    raise_bounds_of_front();
  }
  set_apart();
  return report(worker);
}

/// Answers where no features are known that may be tested against each other, within the reach.
SearchProgress ClosestSearch::find_nothing(SearchWorker& worker) {
  slices_.keep_front(pair_.query.reach, worker);
  set_apart();
  return answer_nothing();
}

SearchProgress ClosestSearch::answer_nothing() {
  pair_.front->touched = false;
  pair_.answer->in_contact = pair_.answer->listed = false;
  pair_.answer->distance = {pair_.query.reach, std::numeric_limits<double>::infinity()};
  pair_.answer->witness = {};
  return SearchProgress::answered;
}

/// Takes up in the front what the tests of its leaves have found.
void ClosestSearch::raise_bounds_of_front() {
  const double motion = pair_.front->motion_now(*pair_.a, *pair_.b);
  for (const LeafPair& leaves : slices_.found().leaves)
    raise(pair_.front->leaves[leaves.listed], leaves, motion);
}

/// Bounds the distance in the front. Nothing is nearer than the closest points found, or pairs left out. The
/// upper bound is good to 2^-40. Of a surface with itself nothing is known: neighbours may pierce each other,
/// and how far apart they are is not asked.
void ClosestSearch::set_apart() {
  const double apart = std::min(closest_.closest.upper * (1 - 0x1p-38), closest_.lower);
  const bool is_of_self = pair_.query.groups != nullptr && pair_.query.groups->is_of_self();
  const bool is_known = apart > 0 && !about_vertices() && !is_of_self;
  LeafFront& front = *pair_.front;
  front.apart = is_known ? rounded_down((apart + front.motion_now(*pair_.a, *pair_.b)) * round_down) : 0;
}

SearchProgress ClosestSearch::report(SearchWorker& worker) {
  const PairQuery& query = pair_.query;
  PairAnswer& answer = *pair_.answer;
  LeafFront& front = *pair_.front;
  const FeaturePairKey& nearest = closest_.closest.keys.front();
  const bool is_below = is_closer_than(worker.pair, nearest, query.threshold);
  answer.in_contact = is_below || (!about_vertices() && closest_.closest.pierced);
  const bool in_reach = closest_.lower < query.reach || is_closer_than(worker.pair, nearest, query.reach);
  answer.listed = answer.in_contact || in_reach;
  const bool touched = std::exchange(front.touched, closest_.closest.upper == 0);
  if (front.touched && !touched) sort_front();
  if (!answer.listed) return SearchProgress::answered;
  set_distance(answer, worker.pair, nearest);
  // An edge and a face that pierce may be neighbours. Once they are apart they bound nothing.
  const bool may_be_left_out = worker.pair.is_of_self() && is_edge_through_face(nearest);
  front.witness = may_be_left_out
                      ? LastWitness()
                      : last_witness_of(worker.pair, nearest, answer.witness.point_a, answer.witness.point_b);
  answer.distance.lower = std::min(answer.distance.lower, closest_.lower);
  if (query.detail != ContactDetail::closest || !answer.in_contact) return SearchProgress::answered;
  const auto& keys = closest_.closest.keys.keys();
  answer.contacts.push_back(is_below ? closest_contact(worker.pair, keys, worker.scratch.parallel)
                                     : measure(worker.pair, lowest_piercing(keys)));
  answer.witness = witness_of(answer.contacts.front());
  return SearchProgress::answered;
}

}  // namespace graze
