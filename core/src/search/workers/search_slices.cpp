#include "search/workers/search_slices.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/working_memory.hpp"
#include "core/base/growth_policy.hpp"
#include "walk/validate_front.hpp"

namespace graze {

float rounded_down(double lower) {
  constexpr double least = std::numeric_limits<float>::min();
  constexpr double most = std::numeric_limits<float>::max();
  return lower < least ? 0 : static_cast<float>(std::min(lower, most) * (1 - 0x1p-23));
}

void SearchSlices::begin(bool may_cut) {
  may_cut_ = may_cut;
  clear();
}

bool SearchSlices::are_complete() const {
  const auto slices = all();
  return std::all_of(slices.begin(), slices.end(), [](const SearchSlice& slice) { return slice.complete; });
}

SearchSlice& SearchSlices::add() {
  if (slices_.size() == count_) slices_.emplace_back();
  SearchSlice& slice = slices_[count_++];
  slice.start = {};
  slice.begin = slice.end = 0;
  slice.complete = true;
  slice.found.clear();
  slice.contacts.near.clear();
  slice.contacts.keys.clear();
  slice.contacts.fold.reset();
  slice.contacts.of_vertices.clear();
  slice.contacts.touching.clear();
  slice.contacts.piercing.clear();
  slice.contacts.edges_if_sunk.clear();
  slice.contacts.near_is_too_long = false;
  slice.closest.clear();
  return slice;
}

/// Adds slices that walk from `start`, of `each` pairs.
void SearchSlices::add_walks(std::span<const RegionPair> start, std::size_t each) {
  if (!may_cut_) each = start.size();
  for (std::size_t begin = 0; begin < start.size(); begin += each)
    add().start = start.subspan(begin, std::min(each, start.size() - begin));
}

void SearchSlices::add_range(std::size_t begin, std::size_t end, std::size_t each) {
  if (!may_cut_) each = end - begin;
  for (; begin < end; begin += std::min(each, end - begin)) {
    SearchSlice& slice = add();
    slice.begin = begin;
    slice.end = std::min(begin + each, end);
  }
}

void SearchSlices::cut_front() {
  if (!is_about_vertices(pair_.query.detail) && pair_.query.groups == nullptr)
    validate(*pair_.front, *pair_.a, *pair_.b);
  clear();
  add_range(0, pair_.front->leaves.size(), front_pairs_each);
}

void SearchSlices::gather_found() {
  found_.clear();
  if (count_ == 1) {
    std::swap(found_, first().found);
    // As much room on either side, so that it does not matter how often they are swapped.
    return first().found.leaves.reserve(found_.leaves.capacity());
  }
  for (const SearchSlice& slice : all()) {
    const LeafPairList& found = slice.found;
    found_.leaves.insert(found_.leaves.end(), found.leaves.begin(), found.leaves.end());
    found_.unlisted_lower_bound = std::min(found_.unlisted_lower_bound, found.unlisted_lower_bound);
  }
}

void SearchSlices::keep_front(double wanted, SearchWorker& worker) {
  LeafFront& front = *pair_.front;
  const PairQuery& query = pair_.query;
  front.forget_leaves();
  front.reached_bits = static_cast<std::uint8_t>(std::bit_width(found_.leaves.size()));
  if (query.slack <= 0) return;
  const auto is_listed = [&](const LeafPair& leaves) { return leaves.lower <= wanted + query.slack; };
  const auto count =
      static_cast<std::size_t>(std::count_if(found_.leaves.begin(), found_.leaves.end(), is_listed));
  if (count > query.front_limit || query.front_limit < least_limit) {
    ++worker.meter.counters().fronts_left_out;
    return;
  }
  reserve_for_one_of_many(front.leaves, count, query.front_limit);
  for (const LeafPair& leaves : found_.leaves) {
    if (is_listed(leaves))
      front.leaves.push_back({leaves.pair, rounded_down(leaves.lower), leaves.feature_lower_bound});
    else
      found_.unlisted_lower_bound = std::min(found_.unlisted_lower_bound, leaves.lower);
  }
  front.unlisted_lower_bound = found_.unlisted_lower_bound;
  front.apart = 0;
  front.travel_a = pair_.a->travel();
  front.travel_b = pair_.b->travel();
}

void SearchSlices::reserve_as(const SearchSlices& other) {
  if (slices_.empty()) slices_.emplace_back();
  reserve_swapped_as(found_.leaves, first().found.leaves, other.found_.leaves, other.first().found.leaves);
}

void SearchSlices::reserve(const PairRoom& room) {
  if (slices_.empty()) slices_.emplace_back();
  for (auto* const leaves : {&found_.leaves, &first().found.leaves}) leaves->reserve(room.leaf_pairs);
}

std::size_t SearchSlices::byte_count() const {
  std::size_t bytes = bytes_of(slices_) + bytes_of(roots_) + bytes_of(found_.leaves);
  for (const SearchSlice& slice : slices_)
    bytes += bytes_of(slice.found.leaves) + bytes_of(slice.contacts.near) + bytes_of(slice.contacts.keys) +
             bytes_of(slice.contacts.of_vertices) + bytes_of(slice.contacts.touching) +
             bytes_of(slice.contacts.runs) + bytes_of(slice.contacts.piercing) +
             bytes_of(slice.contacts.edges_if_sunk) + bytes_of(slice.closest.closest);
  return bytes;
}

}  // namespace graze
