// The part of the search for contacts that orders their keys, and measures them.

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <numeric>
#include <span>

#include "core/base/cut_by_work.hpp"
#include "core/base/growth_policy.hpp"
#include "leaves/feature_pairs.hpp"
#include "measure/measure.hpp"
#include "measure/measure_batch.hpp"
#include "pair/room_in_time.hpp"
#include "search/contact_search.hpp"
#include "search/solid_search.hpp"

namespace graze {
namespace {

constexpr std::size_t keys_each = 1024;
constexpr std::size_t contacts_each = 128;
/// How many keys a slice finds before it hands them over, where contacts are limited.
constexpr std::size_t handed_over_at_once = 8192;

// The least time that a key and a contact take from here on. Where a deadline leaves less than that for all
// of them, the rest of the time is for other pairs.
constexpr std::chrono::nanoseconds to_sort_one{20};
constexpr std::chrono::nanoseconds to_measure_one{40};

}  // namespace

SearchProgress ContactSearch::finish_keys(SearchWorker& worker) {
  if (stage_ == Stage::listed) ++worker.meter.counters().pairs_by_list;
  if (is_listing()) keep_list(worker);
  if (pair_.query.has_solid())
    for (const SearchSlice& slice : slices_.all()) touching_.add(slice.contacts.touching);
  find_nearest_fold(worker);
  find_sunk_edges(worker);
  if (is_limited()) return finish_nearest(worker);
  if (slices_.size() > 1) return begin_ordering();
  keys_.clear();
  if (slices_.size() == 1) {
    auto& found = slices_.first().contacts.keys;
    worker.time.check_for(found.size() * to_sort_one);
    keys_.swap(found);
    found.reserve(keys_.capacity());
  }
  stretches_.assign(1, {0, sort_keys(keys_, worker), {}});
  return begin_measuring(worker);
}

/// Takes the contacts that the slices have handed over, where contacts are limited.
SearchProgress ContactSearch::finish_nearest(SearchWorker& worker) {
  nearest_keys_.finish(worker.pair, keys_, worker.scratch.lowest);
  pair_.answer->cut = nearest_keys_.is_cut();
  if (!keys_.empty()) lowest_ = worker.scratch.lowest.keys.front();
  stretches_.assign(1, {0, keys_.size(), {}});
  return begin_measuring(worker);
}

/// How near contacts are that may be among those that are kept.
double ContactSearch::threshold_now(SearchWorker& worker) {
  return is_limited() ? std::min(pair_.query.threshold, nearest_keys_.limit(worker.pair))
                      : pair_.query.threshold;
}

/// Gives a slice's keys to the list of all slices, so that it need not keep them.
void ContactSearch::hand_over(SearchSlice& slice, SearchWorker& worker) {
  auto& keys = slice.contacts.keys;
  if (keys.empty()) return;
  keys.resize(sort_keys(keys, worker));
  nearest_keys_.add(worker.pair, keys, worker.scratch.measure, worker.scratch.nearest_keys);
  keys.clear();
}

void ContactSearch::hand_over_if_many(SearchSlice& slice, SearchWorker& worker) {
  if (!is_limited()) return;
  if (slice.contacts.keys.size() >= handed_over_at_once) hand_over(slice, worker);
  if (slice.contacts.near.size() <= pair_.query.front_limit) return;
  slice.contacts.near.clear();
  slice.contacts.near_is_too_long = true;
}

/// Puts the keys of one of many slices into bins, for the stage that sorts.
void ContactSearch::bin_keys(SearchSlice& slice, SearchWorker& worker) {
  if (is_limited()) return hand_over(slice, worker);
  if (slices_.size() <= 1) return;
  worker.time.check_for(slice.contacts.keys.size() * to_sort_one);
  worker.scratch.binning.put_into(KeyBins(pair_.a->mesh()), slice.contacts.keys, slice.contacts.runs);
}

/// Cuts what all slices found by bins: the runs of a stretch's bins are what it sorts.
SearchProgress ContactSearch::begin_ordering() {
  stage_ = Stage::ordered;
  std::array<std::uint32_t, KeyBins::count + 1> first_run{};
  std::array<std::size_t, KeyBins::count> keys{};
  const auto slices = slices_.all();
  for (const SearchSlice& slice : slices)
    for (const BinRun& run : slice.contacts.runs) {
      ++first_run[run.bin + 1];
      keys[run.bin] += run.end - run.begin;
    }
  for (std::size_t bin = 0; bin < KeyBins::count; ++bin) first_run[bin + 1] += first_run[bin];
  std::size_t begin = 0;
  stretches_.clear();
  cut_by_work(
      0, KeyBins::count, keys_each, [&](std::size_t bin) { return keys[bin]; },
      [&](std::size_t first, std::size_t last) {
        const auto end = std::accumulate(keys.begin() + first, keys.begin() + last, begin);
        stretches_.push_back({begin, end, {first_run[first], first_run[last]}});
        begin = end;
      });
  runs_.resize(first_run.back());
  for (const SearchSlice& slice : slices)
    for (const BinRun& run : slice.contacts.runs)
      runs_[first_run[run.bin]++] = std::span(slice.contacts.keys).subspan(run.begin, run.end - run.begin);
  resize_to_overwrite(keys_, begin);
  return SearchProgress::slices;
}

void ContactSearch::order(Stretch& stretch, SearchWorker& worker) {
  const auto keys = std::span(keys_).subspan(stretch.begin, stretch.end - stretch.begin);
  auto to = keys.begin();
  for (std::size_t run = stretch.runs.begin; run < stretch.runs.end; ++run)
    to = std::copy(runs_[run].begin(), runs_[run].end(), to);
  stretch.end = stretch.begin + sort_keys(keys, worker);
}

/// Sorts keys, and returns how many of the first are contacts.
std::size_t ContactSearch::sort_keys(std::span<FeaturePairKey> keys, SearchWorker& worker) const {
  worker.scratch.order.make_room(keys.size(), worker.pair.time);
  worker.scratch.order.sort(keys);
  return lists_piercings(pair_.query.detail) ? keep_nearest_of_each(worker.pair, keys) : keys.size();
}

SearchProgress ContactSearch::begin_measuring(SearchWorker& worker) {
  slices_.clear();
  std::size_t count = 0;
  for (const Stretch& stretch : stretches_) count += stretch.end - stretch.begin;
  if (count == 0) return finish_without_contacts(worker);
  keep_time_back(count, worker);
  stage_ = Stage::measured;
  make_room_in_time(pair_.answer->contacts, count, worker.pair.time);
  std::size_t contact = 0;
  for (const Stretch& stretch : stretches_) {
    const std::size_t first = slices_.size();
    slices_.add_range(stretch.begin, stretch.end, contacts_each);
    for (SearchSlice& slice : slices_.all().subspan(first)) {
      slice.contacts.first = contact;
      contact += slice.end - slice.begin;
    }
  }
  return SearchProgress::slices;
}

/// Asks for the closest points where these may be in reach, or where something is inside a solid.
SearchProgress ContactSearch::finish_without_contacts(SearchWorker& worker) {
  if (pair_.query.has_solid() && !SolidSearch(pair_, worker, touching()).widen_reach())
    return SearchProgress::gave_up;
  if (fold_) return finish_at_fold(worker);
  if (pair_.query.reach > pair_.query.threshold) return SearchProgress::no_contact;
  pair_.answer->contacts.clear();
  return SearchProgress::answered;
}

/// Keeps back the time that the caller needs for so many contacts when they have been measured.
void ContactSearch::keep_time_back(std::size_t contacts, SearchWorker& worker) {
  if (!worker.time.is_set()) return;
  pair_.query.deadline -= contacts * pair_.query.time_after_contact;
  worker.time.set_deadline(pair_.query.deadline);
  worker.time.check_for(contacts * to_measure_one);
}

std::span<const FeaturePairKey> ContactSearch::keys_of(const SearchSlice& slice) const {
  return std::span(keys_).subspan(slice.begin, slice.end - slice.begin);
}

std::span<Contact> ContactSearch::contacts_of(const SearchSlice& slice) const {
  return std::span(pair_.answer->contacts).subspan(slice.contacts.first, slice.end - slice.begin);
}

void ContactSearch::run_measured(SearchSlice& slice, SearchWorker& worker) {
  const std::span<Contact> contacts = contacts_of(slice);
  measure(worker.pair, keys_of(slice), contacts, worker.scratch.measure);
  sunk_edges_.mark(contacts);
  slice.contacts.nearest = std::numeric_limits<double>::infinity();
  for (const Contact& contact : contacts)
    slice.contacts.nearest = std::min(slice.contacts.nearest, contact.distance);
}

SearchProgress ContactSearch::finish_measuring(SearchWorker& worker) {
  FeaturePairKey lowest = is_limited() ? *lowest_ : lowest_measured(worker);
  if (lowest_) lowest = lower_of(worker, lowest, *lowest_);
  if (fold_) lowest = lower_of(worker, lowest, fold_->key);
  set_distance(*pair_.answer, worker.pair, lowest);
  pair_.answer->in_contact = pair_.answer->listed = true;
  slices_.clear();
  return SearchProgress::answered;
}

/// The nearer of two keys, and of equally near ones the lower.
FeaturePairKey ContactSearch::lower_of(SearchWorker& worker, const FeaturePairKey& left,
                                       const FeaturePairKey& right) {
  worker.scratch.lowest.clear();
  ClosestSet closest(worker.pair, Ties::lowest, worker.scratch.lowest);
  closest.offer(left);
  closest.offer(right);
  return closest.front();
}

/// The lowest key at the least distance, among contacts that have been measured.
FeaturePairKey ContactSearch::lowest_measured(SearchWorker& worker) const {
  worker.scratch.lowest.clear();
  ClosestSet closest(worker.pair, Ties::lowest, worker.scratch.lowest);
  const auto slices = slices_.all();
  double nearest = std::numeric_limits<double>::infinity();
  for (const SearchSlice& slice : slices) nearest = std::min(nearest, slice.contacts.nearest);
  // More than the rounding of a contact's distance, which is relative to the size of its features and their
  // gap; those are inside the objects' boxes.
  const double size = (pair_.a->box().max - pair_.a->box().min).maxCoeff() +
                      (pair_.b->box().max - pair_.b->box().min).maxCoeff();
  const auto may_be_nearest = [&](double distance) {
    return distance <= nearest + (size + distance) * 0x1p-44;
  };
  for (const SearchSlice& slice : slices) {
    if (!may_be_nearest(slice.contacts.nearest)) continue;
    const auto keys = keys_of(slice);
    const auto contacts = contacts_of(slice);
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (may_be_nearest(contacts[i].distance)) closest.offer(keys[i]);
  }
  return closest.front();
}

}  // namespace graze
