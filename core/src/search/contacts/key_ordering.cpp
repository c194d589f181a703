#include "search/contacts/key_ordering.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>

#include "core/base/cut_by_work.hpp"
#include "core/base/growth_policy.hpp"
#include "leaves/feature_pairs.hpp"

namespace graze {
namespace {

constexpr std::size_t keys_each = 1024;
/// How many keys a slice finds before it hands them over, where contacts are limited.
constexpr std::size_t handed_over_at_once = 8192;
/// The least time that a key takes to be sorted. Where a deadline leaves less than that for all of them, the
/// rest of the time is for other pairs.
constexpr std::chrono::nanoseconds to_sort_one{20};

}  // namespace

std::size_t OrderedKeys::count() const {
  std::size_t count = 0;
  for (const Stretch& stretch : stretches) count += stretch.end - stretch.begin;
  return count;
}

void KeyOrdering::begin(bool may_repeat_features) {
  may_repeat_features_ = may_repeat_features;
  ordered_.lowest.reset();
}

std::size_t KeyOrdering::sort(std::span<FeaturePairKey> keys, SearchWorker& worker) const {
  worker.scratch.order.make_room(keys.size(), worker.pair.time);
  worker.scratch.order.sort(keys);
  return may_repeat_features_ ? keep_nearest_of_each(worker.pair, keys) : keys.size();
}

// ---- All keys

void AllOrdering::take(SearchSlice& slice, SearchWorker& worker) {
  if (slices_.size() <= 1) return;
  worker.time.check_for(slice.contacts.keys.size() * to_sort_one);
  worker.scratch.binning.put_into(KeyBins(pair_.a->mesh()), slice.contacts.keys, slice.contacts.runs);
}

bool AllOrdering::begin_ordering(SearchWorker& worker) {
  if (slices_.size() > 1) {
    cut_into_stretches();
    return true;
  }
  order_only_slice(worker);
  return false;
}

void AllOrdering::order_only_slice(SearchWorker& worker) {
  auto& keys = ordered_.keys;
  keys.clear();
  if (slices_.size() == 1) {
    auto& found = slices_.first().contacts.keys;
    worker.time.check_for(found.size() * to_sort_one);
    keys.swap(found);
    found.reserve(keys.capacity());
  }
  ordered_.stretches.assign(1, {0, sort(keys, worker), {}});
}

/// Cuts what all slices found by bins: the runs of a stretch's bins are what it sorts.
void AllOrdering::cut_into_stretches() {
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
  ordered_.stretches.clear();
  cut_by_work(
      0, KeyBins::count, keys_each, [&](std::size_t bin) { return keys[bin]; },
      [&](std::size_t first, std::size_t last) {
        const auto end = std::accumulate(keys.begin() + first, keys.begin() + last, begin);
        ordered_.stretches.push_back({begin, end, {first_run[first], first_run[last]}});
        begin = end;
      });
  runs_.resize(first_run.back());
  for (const SearchSlice& slice : slices)
    for (const BinRun& run : slice.contacts.runs)
      runs_[first_run[run.bin]++] = std::span(slice.contacts.keys).subspan(run.begin, run.end - run.begin);
  resize_to_overwrite(ordered_.keys, begin);
}

void AllOrdering::order(Stretch& stretch, SearchWorker& worker) {
  const auto keys = std::span(ordered_.keys).subspan(stretch.begin, stretch.end - stretch.begin);
  auto to = keys.begin();
  for (std::size_t run = stretch.runs.begin; run < stretch.runs.end; ++run)
    to = std::copy(runs_[run].begin(), runs_[run].end(), to);
  stretch.end = stretch.begin + sort(keys, worker);
}

// ---- The closest keys

void ClosestOrdering::begin(bool may_repeat_features) {
  KeyOrdering::begin(may_repeat_features);
  nearest_.begin(pair_.closest_kept());
}

double ClosestOrdering::threshold_now(const SearchWorker& worker) const {
  return std::min(pair_.query.threshold, nearest_.limit(worker.pair));
}

void ClosestOrdering::hand_over_if_many(SearchSlice& slice, SearchWorker& worker) {
  if (slice.contacts.keys.size() >= handed_over_at_once) hand_over(slice, worker);
}

void ClosestOrdering::hand_over(SearchSlice& slice, SearchWorker& worker) {
  auto& keys = slice.contacts.keys;
  if (keys.empty()) return;
  keys.resize(sort(keys, worker));
  nearest_.add(worker.pair, keys, worker.scratch.measure, worker.scratch.nearest_keys);
  keys.clear();
}

bool ClosestOrdering::begin_ordering(SearchWorker& worker) {
  nearest_.finish(worker.pair, ordered_.keys, worker.scratch.lowest);
  pair_.answer->cut = nearest_.is_cut();
  if (!ordered_.keys.empty()) ordered_.lowest = worker.scratch.lowest.keys.front();
  ordered_.stretches.assign(1, {0, ordered_.keys.size(), {}});
  return false;
}

}  // namespace graze
