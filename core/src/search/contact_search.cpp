#include "search/contact_search.hpp"

#include <algorithm>
#include <chrono>
#include <tuple>

#include "core/base/cut_by_work.hpp"
#include "leaves/closest_vertices.hpp"
#include "leaves/feature_pairs.hpp"
#include "pair/room_in_time.hpp"

namespace graze {
namespace {

constexpr std::size_t leaf_pairs_each = 8;
constexpr std::size_t blocks_each = 64;

/// The least time that it takes to find a key.
constexpr std::chrono::nanoseconds to_find_one{5};

}  // namespace

/// Uses the near list of an earlier query where it still has all that can be in contact.
SearchProgress ContactSearch::begin(SearchWorker& worker) {
  if (is_limited()) nearest_keys_.begin(pair_.query.contact_limit);
  lowest_.reset();
  list_slack_ = 0;
  touching_.clear();
  sunk_edges_.clear();
  fold_.reset();
  if (pair_.query.detail != ContactDetail::regions) {
    const NearList* const near = pair_.front->list_for(*pair_.a, *pair_.b, pair_.query.threshold);
    if (near != nullptr) return begin_listed(*near);
    choose_list_slack();
  }
  return pair_.query.detail == ContactDetail::vertices ? begin_vertices(worker) : begin_reach(worker);
}

SearchProgress ContactSearch::next_stage(SearchWorker& worker) {
  switch (stage_) {
    case Stage::reach:
      return begin_contacts(worker);
    case Stage::ordered:
      for (const Stretch& stretch : stretches_)
        if (!stretch.complete) return SearchProgress::gave_up;
      return begin_measuring(worker);
    case Stage::measured:
      return finish_measuring(worker);
    case Stage::listed:
    case Stage::contacts:
      if (has_nearest_to_choose()) return begin_nearest(worker);
      break;
    case Stage::vertices:
    case Stage::nearest:
      break;
  }
  return finish_keys(worker);
}

std::size_t ContactSearch::slice_count() const {
  return stage_ == Stage::ordered ? stretches_.size() : slices_.size();
}

bool& ContactSearch::is_complete(std::size_t index) {
  return stage_ == Stage::ordered ? stretches_[index].complete : slices_[index].complete;
}

void ContactSearch::run(std::size_t index, SearchWorker& worker) {
  switch (stage_) {
    case Stage::reach:
      return run_reach(slices_[index], worker);
    case Stage::ordered:
      return order(stretches_[index], worker);
    case Stage::measured:
      return run_measured(slices_[index], worker);
    case Stage::listed:
      run_listed(slices_[index], worker);
      break;
    case Stage::contacts:
      run_contacts(slices_[index], worker);
      break;
    case Stage::vertices:
      run_vertices(slices_[index], worker);
      break;
    case Stage::nearest:
      run_nearest(slices_[index], worker);
      break;
  }
  if (has_nearest_to_choose()) return;
  bin_keys(slices_[index], worker);
}

void ContactSearch::make_room_until_deadline(SearchWorker& worker) {
  if (slices_.may_cut()) return;
  FoundContacts& contacts = slices_.first().contacts;
  reserve_until_deadline(contacts.keys, to_find_one, worker.pair.time);
  if (is_listing()) reserve_until_deadline(contacts.near, to_find_one, worker.pair.time);
}

void ContactSearch::reserve_as(const ContactSearch& other) {
  FoundContacts& first = slices_.first().contacts;
  const FoundContacts& other_first = other.slices_.first().contacts;
  graze::reserve_as(first.near, other_first.near);
  graze::reserve_as(first.of_vertices, other_first.of_vertices);
  graze::reserve_as(first.touching, other_first.touching);
  graze::reserve_as(touching_, other.touching_);
  graze::reserve_as(first.piercing, other_first.piercing);
  graze::reserve_as(first.edges_if_sunk, other_first.edges_if_sunk);
  sunk_edges_.reserve_as(other.sunk_edges_);
  // The two lists of keys are swapped with each other.
  const std::size_t keys = std::max(other.keys_.capacity(), other_first.keys.capacity());
  keys_.reserve(keys);
  first.keys.reserve(keys);
  stretches_.reserve(1);
  nearest_keys_.reserve_as(other.nearest_keys_);
}

void ContactSearch::reserve(const PairRoom& room) {
  FoundContacts& first = slices_.first().contacts;
  for (auto* const keys : {&keys_, &first.keys}) keys->reserve(keys_of_contact * room.contacts);
  first.near.reserve(keys_of_contact * room.contacts);
  first.piercing.reserve(room.contacts);
  first.edges_if_sunk.reserve(room.contacts);
  sunk_edges_.reserve(room.contacts);
  stretches_.reserve(1);
}

/// The slice of a pair that is not cut is there, since `reserve` was called before.
void ContactSearch::reserve_for_solids() {
  slices_.first().contacts.touching.reserve();
  touching_.reserve();
}

void ContactSearch::reserve_for_limit(std::size_t most, const PairRoom& room) {
  nearest_keys_.reserve(most, keys_of_contact * room.contacts);
}

std::size_t ContactSearch::byte_count() const {
  return bytes_of(keys_) + bytes_of(touching_) + sunk_edges_.byte_count() + bytes_of(stretches_) +
         bytes_of(runs_) + nearest_keys_.byte_count();
}

// ---- Contacts between leaves

/// Whether a pair of leaves this far apart can have a contact, or features to be listed, before the surfaces
/// have moved by `slack`. Surfaces pierce each other at every threshold.
auto ContactSearch::may_touch() const {
  const bool may_pierce = lists_piercings(pair_.query.detail);
  return [wanted = wanted(), may_pierce](double lower, double slack) {
    const double nearest = std::max(0.0, lower - slack);
    return nearest < wanted || (may_pierce && nearest == 0);
  };
}

SearchProgress ContactSearch::begin_reach(SearchWorker& worker) {
  stage_ = Stage::reach;
  is_from_front_ = pair_.front->unlisted_lower_bound_now(*pair_.a, *pair_.b) > wanted();
  if (is_from_front_)
    slices_.cut_front();
  else
    slices_.walk(worker, may_touch(), [](const RegionPair&) {});
  return SearchProgress::slices;
}

void ContactSearch::run_reach(SearchSlice& slice, SearchWorker& worker) {
  if (is_from_front_)
    return worker.leaf_pairs.select_from(*pair_.front, slice.begin, slice.end, wanted(), false, slice.found);
  if (slice.start.empty()) return;
  slice.complete = worker.leaf_pairs.walk(
      slice.start, may_touch(), [](const RegionPair&) {}, slice.found);
}

SearchProgress ContactSearch::begin_contacts(SearchWorker& worker) {
  slices_.gather_found();
  if (!is_from_front_) slices_.keep_front(wanted(), worker);
  stage_ = Stage::contacts;
  slices_.clear();
  auto& leaves = slices_.found().leaves;
  // The nearest come first, so that the limit soon tells which contacts are too far to be kept.
  if (is_limited())
    std::sort(leaves.begin(), leaves.end(), [](const LeafPair& left, const LeafPair& right) {
      return std::tie(left.lower, left.pair.a, left.pair.b) <
             std::tie(right.lower, right.pair.a, right.pair.b);
    });
  cut_leaves();
  return SearchProgress::slices;
}

/// Cuts the leaf pairs found so that every slice has as many to test.
void ContactSearch::cut_leaves() {
  const auto& leaves = slices_.found().leaves;
  if (!slices_.may_cut()) return slices_.add_range(0, leaves.size(), leaves.size());
  cut_by_work(
      0, leaves.size(), leaf_pairs_each,
      [&, may_touch = may_touch()](std::size_t i) { return may_touch(leaves[i].lower, 0) ? 1U : 0U; },
      [&](std::size_t begin, std::size_t end) { slices_.add_range(begin, end, end - begin); });
}

void ContactSearch::run_contacts(SearchSlice& slice, SearchWorker& worker) {
  worker.begin_leaves(slices_.found());
  if (pair_.query.detail == ContactDetail::nearest) {
    NearestFeatures features = nearest_features_in(slice, worker);
    test_leaves(slice, worker, features);
    return keep_nearest(slice, worker);
  }
  CloseFeatures features(worker.pair, pair_.query.threshold, worker.scratch.features, slice.contacts.keys,
                         slice.contacts.piercing, listing_in(slice), touching_in(slice));
  test_leaves(slice, worker, features);
}

template <typename Features>
void ContactSearch::test_leaves(SearchSlice& slice, SearchWorker& worker, Features& features) {
  const double threshold = pair_.query.threshold;
  const auto may_touch_now = may_touch();
  for (std::size_t i = slice.begin; i < slice.end; ++i) {
    const LeafPair& leaves = slices_.found().leaves[i];
    slice.complete = !is_from_front_ || worker.meter.spend();
    if (!slice.complete) return;
    if (!may_touch_now(leaves.lower, 0)) continue;
    if (is_limited()) {
      hand_over_if_many(slice, worker);
      const double threshold_of_kept = is_listing() ? threshold : threshold_now(worker);
      if (leaves.lower > threshold_of_kept && !is_listing()) continue;
      features.set_threshold(threshold_of_kept);
    }
    if (!may_touch_now(worker.leaf_pairs.lower_by_corners(leaves.pair), 0)) continue;
    ++worker.meter.counters().leaf_pairs_tested;
    const LeafOf a = worker.leaf_pairs.leaf_a(leaves.pair);
    const LeafOf b = worker.leaf_pairs.leaf_b(leaves.pair);
    if (pair_.query.detail == ContactDetail::regions)
      add_closest_vertices(a, b, slice, worker);
    else
      features.add(a, b);
  }
  features.finish();
}

void ContactSearch::add_closest_vertices(const LeafOf& a, const LeafOf& b, SearchSlice& slice,
                                         SearchWorker& worker) const {
  SearchScratch& scratch = worker.scratch;
  const auto key = closest_vertices(worker.pair, a, b, scratch.features, scratch.nearest_of_leaves);
  if (key && is_closer_than(worker.pair, *key, pair_.query.threshold)) slice.contacts.keys.push_back(*key);
}

// ---- Contacts between vertices

/// Finds blocks of vertices by their boxes alone, without a walk.
SearchProgress ContactSearch::begin_vertices(SearchWorker& worker) {
  if (!worker.meter.spend()) return SearchProgress::gave_up;
  stage_ = Stage::vertices;
  NearVertices(worker.pair, wanted(), near_blocks_, worker.scratch.vertices).find_blocks();
  pair_.front->walked = false;
  slices_.clear();
  slices_.add_range(0, near_blocks_.a.count, blocks_each);
  return SearchProgress::slices;
}

void ContactSearch::run_vertices(SearchSlice& slice, SearchWorker& worker) {
  NearVertices vertices(worker.pair, wanted(), near_blocks_, worker.scratch.vertices);
  const std::size_t each = is_limited() ? 1 : slice.end - slice.begin;
  for (std::size_t begin = slice.begin; begin < slice.end && slice.complete; begin += each) {
    slice.complete = vertices.append_near(begin, begin + each, threshold_now(worker), worker.meter,
                                          slice.contacts.keys, listing_in(slice));
    hand_over_if_many(slice, worker);
  }
}

}  // namespace graze
