#include "search/pair_search.hpp"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

#include "core/base/cut_by_work.hpp"
#include "core/base/growth_policy.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/search/pair_detector.hpp"
#include "leaves/closest_vertices.hpp"
#include "leaves/feature_pairs.hpp"
#include "measure/measure.hpp"
#include "measure/measure_batch.hpp"
#include "measure/parallel.hpp"
#include "pair/room_in_time.hpp"
#include "search/pair_search_worker.hpp"
#include "walk/last_witness.hpp"
#include "walk/validate_front.hpp"

namespace graze {
namespace {

// How stages are cut. A slice is some tens of microseconds of work, against about one for giving it to a
// thread; below that a pair is not cut at all.
constexpr std::size_t roots_of_sliced_walk = 1024;
constexpr std::size_t roots_each = 64;
constexpr std::size_t front_pairs_each = 256;
constexpr std::size_t closest_first = 64;  ///< leaf pairs that make the bound tight before others are cut
constexpr std::size_t closest_each = 64;
constexpr std::size_t leaf_pairs_each = 8;
constexpr std::size_t blocks_each = 64;

/// At least so long a key takes to be found.
constexpr std::chrono::nanoseconds to_find_one{5};

/// A bound that is not negative in half of the memory.
float rounded_down(double lower) {
  constexpr double least = std::numeric_limits<float>::min();
  constexpr double most = std::numeric_limits<float>::max();
  return lower < least ? 0 : static_cast<float>(std::min(lower, most) * (1 - 0x1p-23));
}

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

void PairSearch::begin(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
                       PairAnswer& answer, bool sliced) {
  a_ = &a;
  b_ = &b;
  query_ = query;
  front_ = &front;
  answer_ = &answer;
  sliced_ = sliced;
  front.walked = true;
  certainly_apart_ = false;
  stage_ = Stage::start;
  slice_count_ = 0;
  answer.in_contact = answer.listed = answer.cut = false;
  answer.complete = true;
}

bool PairSearch::advance(SearchScratch& scratch, PairCounters& counters) {
  Worker worker(*this, scratch, counters);
  try {
    go_on(worker);
  } catch (const TimeIsUp&) {
    give_up();
  }
  return stage_ == Stage::done;
}

/// As far as a stage of several slices, or the answer.
void PairSearch::go_on(Worker& worker) {
  while (stage_ != Stage::done) {
    next_stage(worker);
    if (slice_count() > 1) return;
    if (slice_count() == 1) run(0, worker);
  }
}

void PairSearch::run_slice(std::size_t index, SearchScratch& scratch, PairCounters& counters) {
  Worker worker(*this, scratch, counters);
  bool& complete = stage_ == Stage::ordered ? stretches_[index].complete : slices_[index].complete;
  // A slice that comes too late is not begun, so that it does not throw either.
  complete = !worker.time.is_set() || worker.time.left() > std::chrono::nanoseconds(0);
  if (!complete) return;
  try {
    run(index, worker);
  } catch (const TimeIsUp&) {
    complete = false;
  }
}

void PairSearch::run(std::size_t index, Worker& worker) {
  stage_ == Stage::ordered ? order(stretches_[index], worker) : run(slices_[index], worker);
}

void PairSearch::next_stage(Worker& worker) {
  for (std::size_t i = 0; i < slice_count_; ++i)
    if (!slices_[i].complete) return give_up();
  if (stage_ == Stage::ordered)
    for (const Stretch& stretch : stretches_)
      if (!stretch.complete) return give_up();
  switch (stage_) {
    case Stage::start:
      if (query_.mode == AccuracyMode::paper) return as_in_paper(worker);
      if (query_.detail == ContactDetail::none || query_.detail == ContactDetail::closest)
        return begin_approach(worker);
      return begin_contact(worker);
    case Stage::reach:
      return begin_contacts(worker);
    case Stage::listed:
    case Stage::contacts:
    case Stage::vertices:
      return finish_contacts(worker);
    case Stage::ordered:
      return begin_measuring(worker);
    case Stage::measured:
      return finish_measuring(worker);
    case Stage::approach:
      return begin_closest(worker);
    case Stage::closest:
      return finish_closest(worker);
    case Stage::done:
      return;
  }
}

void PairSearch::run(Slice& slice, Worker& worker) {
  if (!sliced_) {
    reserve_until_deadline(slice.keys, to_find_one, worker.pair.time);
    if (is_listing_) reserve_until_deadline(slice.near, to_find_one, worker.pair.time);
  }
  switch (stage_) {
    case Stage::listed:
      run_listed(slice, worker);
      return bin_keys(slice, worker);
    case Stage::reach:
      return run_reach(slice, worker);
    case Stage::contacts:
      run_contacts(slice, worker);
      return bin_keys(slice, worker);
    case Stage::vertices:
      run_vertices(slice, worker);
      return bin_keys(slice, worker);
    case Stage::measured:
      return run_measured(slice, worker);
    case Stage::approach:
      return run_approach(slice, worker);
    case Stage::closest:
      seed(slice);
      slice.complete = test_leaves(slice.begin, slice.end, slice.closest, worker);
      return;
    default:
      return;
  }
}

/// Lists that are swapped with each other get the same room, so that it does not matter how often they are.
void PairSearch::reserve_as(const PairSearch& other) {
  if (other.slices_.empty()) return;
  if (slices_.empty()) slices_.emplace_back();
  const std::size_t leaves =
      std::max(other.found_.leaves.capacity(), other.slices_.front().found.leaves.capacity());
  found_.leaves.reserve(leaves);
  slices_.front().found.leaves.reserve(leaves);
  graze::reserve_as(slices_.front().near, other.slices_.front().near);
  const std::size_t keys = std::max(other.keys_.capacity(), other.slices_.front().keys.capacity());
  keys_.reserve(keys);
  slices_.front().keys.reserve(keys);
  stretches_.reserve(1);
  nearest_keys_.reserve_as(other.nearest_keys_);
  graze::reserve_as(near_blocks_, other.near_blocks_);
  graze::reserve_as(closest_.closest, other.closest_.closest);
}

void PairSearch::reserve(const PairRoom& room) {
  if (slices_.empty()) slices_.emplace_back();
  for (auto* const leaves : {&found_.leaves, &slices_.front().found.leaves}) leaves->reserve(room.leaf_pairs);
  for (auto* const keys : {&keys_, &slices_.front().keys}) keys->reserve(keys_of_contact * room.contacts);
  slices_.front().near.reserve(keys_of_contact * room.contacts);
  stretches_.reserve(1);
  graze::reserve(near_blocks_, room);
  graze::reserve(closest_.closest, room);
}

std::size_t PairSearch::byte_count() const {
  std::size_t bytes = bytes_of(slices_) + bytes_of(roots_) + bytes_of(found_.leaves) + bytes_of(keys_) +
                      bytes_of(stretches_) + bytes_of(runs_) + bytes_of(near_blocks_) +
                      bytes_of(closest_.closest) + nearest_keys_.byte_count();
  for (const Slice& slice : slices_)
    bytes += bytes_of(slice.found.leaves) + bytes_of(slice.near) + bytes_of(slice.keys) +
             bytes_of(slice.runs) + bytes_of(slice.closest.closest);
  return bytes;
}

// ---- Slices

PairSearch::Slice& PairSearch::add_slice() {
  if (slices_.size() == slice_count_) slices_.emplace_back();
  Slice& slice = slices_[slice_count_++];
  slice.start = {};
  slice.begin = slice.end = 0;
  slice.complete = true;
  slice.found.clear();
  slice.near.clear();
  slice.keys.clear();
  slice.near_is_too_long = false;
  slice.closest.clear();
  return slice;
}

/// Cuts what starts at `pairs`.
void PairSearch::add_slices_of(std::span<const RegionPair> pairs, std::size_t each) {
  if (!sliced_) each = pairs.size();
  for (std::size_t begin = 0; begin < pairs.size(); begin += each)
    add_slice().start = pairs.subspan(begin, std::min(each, pairs.size() - begin));
}

/// Cuts a range.
void PairSearch::add_slices_of(std::size_t begin, std::size_t end, std::size_t each) {
  if (!sliced_) each = end - begin;
  for (; begin < end; begin += std::min(each, end - begin)) {
    Slice& slice = add_slice();
    slice.begin = begin;
    slice.end = std::min(begin + each, end);
  }
}

/// The slices of the front of the last query.
void PairSearch::slice_front() {
  if (!about_vertices()) validate(*front_, *a_, *b_);
  slice_count_ = 0;
  add_slices_of(0, front_->leaves.size(), front_pairs_each);
}

/// Selects from a slice of the front the pairs that are not further than a distance.
void PairSearch::select_from_front(Slice& slice, double distance, Worker& worker) const {
  worker.leaf_pairs.select_from(*front_, slice.begin, slice.end, distance, certainly_apart_, slice.found);
}

/// Walks until there is enough for many slices; what was found on the way is that of the first slice.
template <typename Keep, typename Meet>
void PairSearch::slice_walk(Worker& worker, const Keep& keep, const Meet& meet) {
  slice_count_ = 0;
  Slice& first = add_slice();
  const RegionPair root;
  const std::size_t most = sliced_ ? roots_of_sliced_walk : std::numeric_limits<std::size_t>::max();
  first.complete = worker.leaf_pairs.walk({&root, 1}, keep, meet, first.found, most);
  if (!first.complete) return;
  const auto rest = worker.leaf_pairs.front();
  roots_.assign(rest.begin(), rest.end());
  add_slices_of(roots_, roots_each);
}

/// Puts the leaf pairs of the slices together.
void PairSearch::gather_found() {
  found_.clear();
  if (slice_count_ == 1) {
    std::swap(found_, slices_.front().found);
    // As much room on either side, so that it does not matter how often they are swapped.
    return slices_.front().found.leaves.reserve(found_.leaves.capacity());
  }
  for (std::size_t i = 0; i < slice_count_; ++i) {
    const LeafPairList& found = slices_[i].found;
    found_.leaves.insert(found_.leaves.end(), found.leaves.begin(), found.leaves.end());
    found_.unlisted_lower_bound = std::min(found_.unlisted_lower_bound, found.unlisted_lower_bound);
  }
}

/// Makes the leaf pairs of a walk the front. Leaves out those that do not matter before the surfaces have
/// moved by the slack, for a search within `wanted`.
void PairSearch::remember(double wanted, Worker& worker) {
  front_->forget_leaves();
  front_->reached_bits = static_cast<std::uint8_t>(std::bit_width(found_.leaves.size()));
  if (query_.slack <= 0) return;
  const auto is_listed = [&](const LeafPair& leaves) { return leaves.lower <= wanted + query_.slack; };
  const auto count =
      static_cast<std::size_t>(std::count_if(found_.leaves.begin(), found_.leaves.end(), is_listed));
  if (count > query_.front_limit || query_.front_limit < least_limit) {
    ++worker.meter.counters().fronts_left_out;
    return;
  }
  reserve_for_one_of_many(front_->leaves, count, query_.front_limit);
  for (const LeafPair& leaves : found_.leaves) {
    if (is_listed(leaves))
      front_->leaves.push_back({leaves.pair, rounded_down(leaves.lower), leaves.feature_lower_bound});
    else
      found_.unlisted_lower_bound = std::min(found_.unlisted_lower_bound, leaves.lower);
  }
  front_->unlisted_lower_bound = found_.unlisted_lower_bound;
  front_->apart = 0;
  front_->travel_a = a_->travel();
  front_->travel_b = b_->travel();
}

void PairSearch::give_up() {
  slice_count_ = 0;
  stage_ = Stage::done;
  PairDetector::outer_bounds(*a_, *b_, query_, *answer_);
}

void PairSearch::set_distance(Worker& worker, const FeaturePairKey& nearest) {
  answer_->distance = rounded_distance(worker.pair, nearest);
  answer_->witness = witness_of(measure_without_sides(worker.pair, nearest));
}

// ---- All contacts of a detail; where there are none, the closest points

/// Whether pairs of leaves this far apart can have a contact, or features to be listed. Surfaces pierce each
/// other at every threshold.
bool PairSearch::may_touch(double lower) const {
  return lower < wanted_ || (query_.detail == ContactDetail::features && lower == 0);
}

/// As `may_touch`, for pairs that may come nearer by the slack that a walk asks about.
auto PairSearch::may_touch_within_slack() const {
  return [this](double lower, double slack) { return may_touch(std::max(0.0, lower - slack)); };
}

void PairSearch::begin_contact(Worker& worker) {
  if (is_limited()) nearest_keys_.begin(query_.contact_limit);
  begin_listing();
  if (stage_ == Stage::listed) return;
  if (query_.detail == ContactDetail::vertices) return begin_vertices(worker);
  stage_ = Stage::reach;
  from_front_ = front_->unlisted_lower_bound_now(*a_, *b_) > wanted_;
  if (from_front_) return slice_front();
  slice_walk(worker, may_touch_within_slack(), [](const RegionPair&) {});
}

/// Without a walk: blocks of vertices are found by their boxes alone.
void PairSearch::begin_vertices(Worker& worker) {
  if (!worker.meter.spend()) return give_up();
  stage_ = Stage::vertices;
  NearVertices(worker.pair, wanted_, near_blocks_, worker.scratch.vertices).find_blocks();
  front_->walked = false;
  slice_count_ = 0;
  add_slices_of(0, near_blocks_.a.count, blocks_each);
}

void PairSearch::run_vertices(Slice& slice, Worker& worker) {
  NearVertices vertices(worker.pair, wanted_, near_blocks_, worker.scratch.vertices);
  const std::size_t each = is_limited() ? 1 : slice.end - slice.begin;
  for (std::size_t begin = slice.begin; begin < slice.end && slice.complete; begin += each) {
    slice.complete = vertices.append_near(begin, begin + each, threshold_now(worker), worker.meter,
                                          slice.keys, listing_in(slice));
    hand_over_if_many(slice, worker);
  }
}

void PairSearch::run_reach(Slice& slice, Worker& worker) {
  if (from_front_) return select_from_front(slice, wanted_, worker);
  if (slice.start.empty()) return;
  slice.complete = worker.leaf_pairs.walk(
      slice.start, may_touch_within_slack(), [](const RegionPair&) {}, slice.found);
}

void PairSearch::begin_contacts(Worker& worker) {
  gather_found();
  if (!from_front_) remember(wanted_, worker);
  stage_ = Stage::contacts;
  slice_count_ = 0;
  // So that it soon is known how near those are that are kept.
  if (is_limited())
    std::sort(found_.leaves.begin(), found_.leaves.end(), [](const LeafPair& left, const LeafPair& right) {
      return std::tie(left.lower, left.pair.a, left.pair.b) <
             std::tie(right.lower, right.pair.a, right.pair.b);
    });
  slice_leaves_in_contact();
}

/// Cuts the leaf pairs found so that every slice has as many to test.
void PairSearch::slice_leaves_in_contact() {
  const auto& leaves = found_.leaves;
  if (!sliced_) return add_slices_of(0, leaves.size(), leaves.size());
  cut_by_work(
      0, leaves.size(), leaf_pairs_each, [&](std::size_t i) { return may_touch(leaves[i].lower) ? 1U : 0U; },
      [&](std::size_t begin, std::size_t end) { add_slices_of(begin, end, end - begin); });
}

void PairSearch::run_contacts(Slice& slice, Worker& worker) {
  worker.begin_leaves(found_);
  CloseFeatures features(worker.pair, query_.threshold, worker.scratch.features, slice.keys,
                         listing_in(slice));
  for (std::size_t i = slice.begin; i < slice.end; ++i) {
    const LeafPair& leaves = found_.leaves[i];
    slice.complete = !from_front_ || worker.meter.spend();
    if (!slice.complete) return;
    if (!may_touch(leaves.lower)) continue;
    if (is_limited()) {
      hand_over_if_many(slice, worker);
      const double threshold = is_listing_ ? query_.threshold : threshold_now(worker);
      if (leaves.lower > threshold && !is_listing_) continue;
      features.set_threshold(threshold);
    }
    ++worker.meter.counters().leaf_pairs_tested;
    const LeafOf a = worker.leaf_pairs.leaf_a(leaves.pair);
    const LeafOf b = worker.leaf_pairs.leaf_b(leaves.pair);
    if (query_.detail == ContactDetail::features)
      features.add(a, b);
    else
      add_closest_vertices(a, b, slice, worker);
  }
  features.finish();
}

void PairSearch::add_closest_vertices(const LeafOf& a, const LeafOf& b, Slice& slice, Worker& worker) const {
  SearchScratch& scratch = worker.scratch;
  const FeaturePairKey key = closest_vertices(worker.pair, a, b, scratch.features, scratch.nearest_of_leaves);
  if (is_closer_than(worker.pair, key, query_.threshold)) slice.keys.push_back(key);
}

// ---- The closest points

/// ContactDetail::closest wants all keys at the least distance; the distance alone needs one.
Ties PairSearch::ties() const {
  return query_.detail == ContactDetail::closest ? Ties::all : Ties::lowest;
}

/// Surfaces that touched mostly still do, and then one point where they do is enough. That is searched for
/// first, alone.
void PairSearch::begin_approach(Worker& worker) {
  answer_->contacts.clear();
  if (query_.detail == ContactDetail::vertices) return approach_vertices(worker);
  front_->walked = true;
  only_touching_ = front_->touched && ties() == Ties::lowest && !about_vertices();
  begin_search(worker);
}

/// By blocks, beginning with what the middle vertices and the last witness say.
void PairSearch::approach_vertices(Worker& worker) {
  closest_.clear();
  ClosestRange range(worker.pair, query_, Ties::lowest, closest_);
  range.offer_middles({});
  range.at_most(upper_distance(worker.pair, front_->witness, true));
  NearVertices vertices(worker.pair, range.limit(), near_blocks_, worker.scratch.vertices);
  vertices.find_blocks();
  if (!vertices.offer(worker.meter, range)) return give_up();
  slice_count_ = 0;
  stage_ = Stage::done;
  if (!closest_.closest.keys.empty()) report_closest(worker);
}

void PairSearch::begin_search(Worker& worker) {
  unlisted_lower_bound_ = front_->unlisted_lower_bound_now(*a_, *b_);
  from_front_ = unlisted_lower_bound_ > 0;
  certainly_apart_ = from_front_ && static_cast<double>(front_->apart) > front_->motion_now(*a_, *b_);
  found_.clear();
  closest_.clear();
  if (only_touching_) return find_touching(worker);
  ClosestRange range(worker.pair, query_, ties(), closest_);
  range.offer_middles({});
  const double of_roots = closest_.closest.upper;
  range.at_most(upper_distance(worker.pair, front_->witness, about_vertices()));
  is_bounded_ = closest_.closest.upper < of_roots;
  approach(worker);
}

/// Middle vertices are also points of the surfaces, and bound their distance where nothing better does.
auto PairSearch::offering_middles(ClosestRange& range) const {
  return [this, &range](const RegionPair& regions) {
    if (!is_bounded_) range.offer_middles(regions);
  };
}

/// Finds the pairs of leaves to test.
void PairSearch::approach(Worker& worker) {
  stage_ = Stage::approach;
  if (from_front_) return slice_front();
  ClosestRange range(worker.pair, query_, ties(), closest_);
  slice_walk(
      worker, [&](double lower, double slack) { return range.keep(lower, slack); }, offering_middles(range));
}

/// A slice goes on from what was known when it was cut, not from what others find meanwhile.
void PairSearch::seed(Slice& slice) const {
  slice.closest.clear();
  if (!closest_.closest.keys.empty()) slice.closest.closest.keys.assign(closest_.closest.keys.front());
  slice.closest.closest.upper = closest_.closest.upper;
}

void PairSearch::run_approach(Slice& slice, Worker& worker) {
  if (from_front_) return select_from_front(slice, closest_.closest.upper, worker);
  if (slice.start.empty()) return;
  seed(slice);
  ClosestRange range(worker.pair, query_, ties(), slice.closest);
  slice.complete = worker.leaf_pairs.walk(
      slice.start, [&](double lower, double slack) { return range.keep(lower, slack); },
      offering_middles(range), slice.found);
}

void PairSearch::take_up_closest(Worker& worker) {
  ClosestSet set(worker.pair, ties(), closest_.closest);
  for (std::size_t i = 0; i < slice_count_ && !set.is_decided(query_.threshold); ++i) {
    const ClosestFound& found = slices_[i].closest;
    for (const FeaturePairKey& key : found.closest.keys.keys()) set.offer(key);
    closest_.closest.pierced = closest_.closest.pierced || found.closest.pierced;
    closest_.lower = std::min(closest_.lower, found.lower);
  }
  set.merge_runs();
}

void PairSearch::begin_closest(Worker& worker) {
  gather_found();
  take_up_closest(worker);
  slice_count_ = 0;
  stage_ = Stage::closest;
  auto& leaves = found_.leaves;
  const std::size_t near = sort_near_first(leaves, closest_.closest.upper, touching_order());
  const std::size_t first = sliced_ ? std::min(near, closest_first) : near;
  if (!test_leaves(0, first, closest_, worker)) return give_up();
  // Leaf pairs are kept or not by their lower bounds alone, which ascend.
  ClosestRange range(worker.pair, query_, ties(), closest_);
  std::size_t end = first;
  while (end < near && !range.is_decided() && range.keep(leaves[end].lower)) ++end;
  add_slices_of(first, end, closest_each);
}

/// Tests a range of the leaf pairs found, as far as need be; false when the budget ran out.
///
/// Leaf pairs whose boxes overlap now are always these, in this order, whatever was known of earlier steps.
/// So a witness at distance 0 does not depend on those either.
bool PairSearch::test_leaves(std::size_t begin, std::size_t end, ClosestFound& found, Worker& worker) {
  worker.begin_leaves(found_);
  ClosestRange range(worker.pair, query_, ties(), found, !certainly_apart_);
  for (std::size_t i = begin; i < end && !range.is_decided(); ++i) {
    LeafPair& leaves = found_.leaves[i];
    if (!range.keep(leaves.lower)) continue;
    if (!test_leaves(leaves, range, worker)) return false;
  }
  return true;
}

/// Tests two leaves, and updates their bounds; false when the budget ran out.
bool PairSearch::test_leaves(LeafPair& leaves, ClosestRange& range, Worker& worker) const {
  if (!worker.meter.spend()) return false;
  ++worker.meter.counters().leaf_pairs_tested;
  const LeafOf a = worker.leaf_pairs.leaf_a(leaves.pair);
  const LeafOf b = worker.leaf_pairs.leaf_b(leaves.pair);
  if (about_vertices())
    range.offer_vertices(a, b, worker.scratch.features);
  else
    leaves.feature_lower_bound = rounded_down(range.offer_features(a, b, worker.scratch.features));
  return true;
}

void PairSearch::finish_closest(Worker& worker) {
  take_up_closest(worker);
  slice_count_ = 0;
  if (closest_.closest.keys.empty()) {
    only_touching_ = false;
    return begin_search(worker);
  }
  if (from_front_) {
    // The answer is decided, unless something outside the front may be as near as the nearest in it.
    if (ClosestRange(worker.pair, query_, ties(), closest_).keep(unlisted_lower_bound_)) {
      from_front_ = certainly_apart_ = false;
      closest_.lower = std::numeric_limits<double>::infinity();
      return approach(worker);
    }
    const double motion = front_->motion_now(*a_, *b_);
    for (const LeafPair& leaves : found_.leaves) raise(front_->leaves[leaves.listed], leaves, motion);
  } else {
    remember(std::max(query_.threshold, std::min(closest_.closest.upper, query_.reach)), worker);
  }
  set_apart();
  stage_ = Stage::done;
  report_closest(worker);
}

/// Nothing is nearer than what was found, which an upper distance says to 2^-40, and what was left out.
void PairSearch::set_apart() {
  const double apart = std::min(closest_.closest.upper * (1 - 0x1p-38), closest_.lower);
  const bool is_known = apart > 0 && !about_vertices();
  front_->apart = is_known ? rounded_down((apart + front_->motion_now(*a_, *b_)) * round_down) : 0;
}

void PairSearch::report_closest(Worker& worker) {
  const FeaturePairKey& nearest = closest_.closest.keys.front();
  const bool is_below = is_closer_than(worker.pair, nearest, query_.threshold);
  answer_->in_contact = is_below || (!about_vertices() && closest_.closest.pierced);
  const bool in_reach = closest_.lower < query_.reach || is_closer_than(worker.pair, nearest, query_.reach);
  answer_->listed = answer_->in_contact || in_reach;
  const bool touched = std::exchange(front_->touched, closest_.closest.upper == 0);
  if (front_->touched && !touched) sort_front();
  if (!answer_->listed) return;
  set_distance(worker, nearest);
  front_->witness = last_witness_of(worker.pair, nearest, answer_->witness.point_a, answer_->witness.point_b);
  answer_->distance.lower = std::min(answer_->distance.lower, closest_.lower);
  if (query_.detail != ContactDetail::closest || !answer_->in_contact) return;
  const auto& keys = closest_.closest.keys.keys();
  answer_->contacts.push_back(is_below ? closest_contact(worker.pair, keys, worker.scratch.parallel)
                                       : measure(worker.pair, lowest_piercing(keys)));
  answer_->witness = witness_of(answer_->contacts.front());
}

// ---- As in the paper

void PairSearch::as_in_paper(Worker& worker) {
  answer_->contacts.clear();
  keys_.clear();
  const PaperFound found = find_as_in_paper(worker.pair, query_, worker.scratch.paper, worker.meter, keys_);
  if (!found.complete) return give_up();
  stage_ = Stage::done;
  if (is_limited()) {
    nearest_keys_.begin(query_.contact_limit);
    nearest_keys_.add(worker.pair, keys_, worker.scratch.measure, worker.scratch.nearest_keys);
    nearest_keys_.finish(worker.pair, keys_, worker.scratch.lowest);
    answer_->cut = nearest_keys_.is_cut();
  }
  for (const FeaturePairKey& key : keys_) {
    worker.pair.check_time();
    answer_->contacts.push_back(measure(worker.pair, key));
  }
  set_distance(worker, worker.scratch.paper.closest.keys.front());
  answer_->distance.lower = std::min(answer_->distance.lower, found.lower);
  answer_->in_contact = !keys_.empty();
  answer_->listed = answer_->in_contact || answer_->distance.lower < query_.reach;
}

}  // namespace graze
