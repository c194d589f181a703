#include "pair_selection.hpp"

#include <algorithm>
#include <functional>
#include <graze/bytes_of.hpp>

namespace graze {
namespace {

/// Pairs looked at at a time.
constexpr std::size_t pairs_of_slice = 4096;

}  // namespace

bool PairSelection::takes(const ObjectSummary& a, const ObjectSummary& b, const PairFilter& filter,
                          Slice& slice) {
  switch (filter.verdict(a, b)) {
    case PairVerdict::fixed:
      return ++slice.fixed, false;
    case PairVerdict::layer:
      return ++slice.layer, false;
    case PairVerdict::group:
      return ++slice.group, false;
    case PairVerdict::ignored:
      return ++slice.ignored, false;
    case PairVerdict::looked_at:
      break;
  }
  if (!may_be_near(lower_distance(a.box, b.box), filter.reach(a, b))) return ++slice.apart, false;
  return !a.frozen && !b.frozen;
}

std::span<const PlacePair> PairSelection::select(std::span<const PlacePair> pairs,
                                                 const ObjectSummaries& summaries, const PairFilter& filter,
                                                 TaskPool& tasks, StepStatistics& statistics) {
  selected_.resize(pairs.size());
  slices_.assign((pairs.size() + pairs_of_slice - 1) / pairs_of_slice, {});
  const auto select_slice = [&](unsigned, std::size_t index) {
    const std::size_t begin = index * pairs_of_slice;
    const std::size_t end = std::min(begin + pairs_of_slice, pairs.size());
    Slice slice;
    for (std::size_t i = begin; i < end; ++i)
      if (takes(summaries[first_of(pairs[i])], summaries[second_of(pairs[i])], filter, slice))
        selected_[begin + slice.selected++] = pairs[i];
    slices_[index] = slice;
  };
  tasks.run(slices_.size(), std::ref(select_slice));
  std::size_t count = 0;
  statistics.pairs_close = pairs.size();
  for (std::size_t index = 0; index < slices_.size(); ++index) {
    const Slice& slice = slices_[index];
    const auto from = selected_.begin() + static_cast<std::ptrdiff_t>(index * pairs_of_slice);
    std::copy_n(from, slice.selected, selected_.begin() + static_cast<std::ptrdiff_t>(count));
    count += slice.selected;
    statistics.pairs_fixed += slice.fixed;
    statistics.pairs_by_layer += slice.layer;
    statistics.pairs_in_group += slice.group;
    statistics.pairs_ignored += slice.ignored;
    statistics.pairs_apart += slice.apart;
  }
  statistics.pairs_filtered = statistics.pairs_fixed + statistics.pairs_by_layer + statistics.pairs_in_group +
                              statistics.pairs_ignored;
  return std::span(selected_).first(count);
}

void PairSelection::reserve(std::size_t pairs) {
  selected_.reserve(pairs);
  slices_.reserve(pairs / pairs_of_slice + 1);
}

std::size_t PairSelection::byte_count() const {
  return bytes_of(selected_) + bytes_of(slices_);
}

}  // namespace graze
