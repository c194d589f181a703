// The part of a pair's search that orders the keys of contacts, and measures them.

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
#include "search/pair_search.hpp"
#include "search/pair_search_worker.hpp"

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

void PairSearch::finish_contacts(Worker& worker) {
  if (stage_ == Stage::listed) ++worker.meter.counters().pairs_by_list;
  if (is_listing_) keep_list(worker);
  if (is_limited()) return finish_nearest(worker);
  if (slice_count_ > 1) return begin_ordering();
  keys_.clear();
  if (slice_count_ == 1) {
    worker.time.check_for(slices_.front().keys.size() * to_sort_one);
    keys_.swap(slices_.front().keys);
    slices_.front().keys.reserve(keys_.capacity());
  }
  stretches_.assign(1, {0, sort_keys(keys_, worker), {}});
  begin_measuring(worker);
}

/// Takes the contacts that the slices have handed over, where contacts are limited.
void PairSearch::finish_nearest(Worker& worker) {
  nearest_keys_.finish(worker.pair, keys_, worker.scratch.lowest);
  answer_->cut = nearest_keys_.is_cut();
  if (!keys_.empty()) lowest_ = worker.scratch.lowest.keys.front();
  stretches_.assign(1, {0, keys_.size(), {}});
  begin_measuring(worker);
}

/// How near contacts are that may be among those that are kept.
double PairSearch::threshold_now(Worker& worker) {
  return is_limited() ? std::min(query_.threshold, nearest_keys_.limit(worker.pair)) : query_.threshold;
}

/// Gives a slice's keys to the list of all slices, so that it need not keep them.
void PairSearch::hand_over(Slice& slice, Worker& worker) {
  if (slice.keys.empty()) return;
  const std::size_t count = sort_keys(slice.keys, worker);
  nearest_keys_.add(worker.pair, std::span(slice.keys).first(count), worker.scratch.measure,
                    worker.scratch.nearest_keys);
  slice.keys.clear();
}

void PairSearch::hand_over_if_many(Slice& slice, Worker& worker) {
  if (!is_limited()) return;
  if (slice.keys.size() >= handed_over_at_once) hand_over(slice, worker);
  if (slice.near.size() <= query_.front_limit) return;
  slice.near.clear();
  slice.near_is_too_long = true;
}

/// Puts the keys of one of many slices into bins, for the stage that sorts.
void PairSearch::bin_keys(Slice& slice, Worker& worker) {
  if (is_limited()) return hand_over(slice, worker);
  if (slice_count_ <= 1) return;
  worker.time.check_for(slice.keys.size() * to_sort_one);
  worker.scratch.binning.put_into(KeyBins(a_->mesh()), slice.keys, slice.runs);
}

/// Cuts what all slices found by bins: the runs of a stretch's bins are what it sorts.
void PairSearch::begin_ordering() {
  stage_ = Stage::ordered;
  std::array<std::uint32_t, KeyBins::count + 1> first_run{};
  std::array<std::size_t, KeyBins::count> keys{};
  const auto slices = std::span(slices_).first(slice_count_);
  for (const Slice& slice : slices)
    for (const BinRun& run : slice.runs) {
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
  for (const Slice& slice : slices)
    for (const BinRun& run : slice.runs)
      runs_[first_run[run.bin]++] = std::span(slice.keys).subspan(run.begin, run.end - run.begin);
  resize_to_overwrite(keys_, begin);
}

void PairSearch::order(Stretch& stretch, Worker& worker) {
  const auto keys = std::span(keys_).subspan(stretch.begin, stretch.end - stretch.begin);
  auto to = keys.begin();
  for (std::size_t run = stretch.runs.begin; run < stretch.runs.end; ++run)
    to = std::copy(runs_[run].begin(), runs_[run].end(), to);
  stretch.end = stretch.begin + sort_keys(keys, worker);
}

/// Sorts keys, and returns how many of the first are contacts.
std::size_t PairSearch::sort_keys(std::span<FeaturePairKey> keys, Worker& worker) const {
  worker.scratch.order.make_room(keys.size(), worker.pair.time);
  worker.scratch.order.sort(keys);
  return query_.detail == ContactDetail::features ? keep_nearest_of_each(worker.pair, keys) : keys.size();
}

void PairSearch::begin_measuring(Worker& worker) {
  slice_count_ = 0;
  std::size_t count = 0;
  for (const Stretch& stretch : stretches_) count += stretch.end - stretch.begin;
  if (count == 0 && query_.reach <= query_.threshold) {
    answer_->contacts.clear();
    stage_ = Stage::done;
    return;
  }
  if (count == 0) return begin_approach(worker);
  keep_time_back(count, worker);
  stage_ = Stage::measured;
  make_room_in_time(answer_->contacts, count, worker.pair.time);
  std::size_t contact = 0;
  for (const Stretch& stretch : stretches_) {
    const std::size_t first = slice_count_;
    add_slices_of(stretch.begin, stretch.end, contacts_each);
    for (Slice& slice : std::span(slices_).subspan(first, slice_count_ - first)) {
      slice.first_contact = contact;
      contact += slice.end - slice.begin;
    }
  }
}

/// Keeps back the time that the caller needs for so many contacts when they have been measured.
void PairSearch::keep_time_back(std::size_t contacts, Worker& worker) {
  if (!worker.time.is_set()) return;
  query_.deadline -= contacts * query_.time_after_contact;
  worker.time.set_deadline(query_.deadline);
  worker.time.check_for(contacts * to_measure_one);
}

std::span<const FeaturePairKey> PairSearch::keys_of(const Slice& slice) const {
  return std::span(keys_).subspan(slice.begin, slice.end - slice.begin);
}

std::span<Contact> PairSearch::contacts_of(const Slice& slice) const {
  return std::span(answer_->contacts).subspan(slice.first_contact, slice.end - slice.begin);
}

void PairSearch::run_measured(Slice& slice, Worker& worker) {
  const std::span<Contact> contacts = contacts_of(slice);
  measure(worker.pair, keys_of(slice), contacts, worker.scratch.measure);
  slice.nearest = std::numeric_limits<double>::infinity();
  for (const Contact& contact : contacts) slice.nearest = std::min(slice.nearest, contact.distance);
}

void PairSearch::finish_measuring(Worker& worker) {
  set_distance(worker, is_limited() ? lowest_ : lowest_measured(worker));
  answer_->in_contact = answer_->listed = true;
  slice_count_ = 0;
  stage_ = Stage::done;
}

/// The lowest key at the least distance, among contacts that have been measured.
FeaturePairKey PairSearch::lowest_measured(Worker& worker) const {
  worker.scratch.lowest.clear();
  ClosestSet closest(worker.pair, Ties::lowest, worker.scratch.lowest);
  const auto slices = std::span(slices_).first(slice_count_);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Slice& slice : slices) nearest = std::min(nearest, slice.nearest);
  // More than the rounding of a contact's distance, which is relative to the size of its features and their
  // gap; those are inside the objects' boxes.
  const double size = (a_->box().max - a_->box().min).maxCoeff() + (b_->box().max - b_->box().min).maxCoeff();
  const auto may_be_nearest = [&](double distance) {
    return distance <= nearest + (size + distance) * 0x1p-44;
  };
  for (const Slice& slice : slices) {
    if (!may_be_nearest(slice.nearest)) continue;
    const auto keys = keys_of(slice);
    const auto contacts = contacts_of(slice);
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (may_be_nearest(contacts[i].distance)) closest.offer(keys[i]);
  }
  return closest.front();
}

}  // namespace graze
