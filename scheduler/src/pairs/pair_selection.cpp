#include "pairs/pair_selection.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// The number of pairs that one task processes, and about how long one takes.
constexpr std::size_t pairs_of_slice = 1024;
constexpr double nanoseconds_each_selected = 20;
static_assert(pairs_of_slice <= std::numeric_limits<decltype(SelectedPair::count)>::max());

/// The index in an ascending array at which `pair` is or would be.
template <typename Array>
std::size_t index_in(const Array& array, SlotPair pair) {
  const auto found = std::lower_bound(array.begin(), array.end(), pair,
                                      [](const auto& each, SlotPair value) { return each.pair < value; });
  return static_cast<std::size_t>(found - array.begin());
}

}  // namespace

/// The input that all tasks read.
struct PairSelection::Given {
  std::span<const SlotPair> pairs;
  std::span<const ListedPair> listed;
  const ObjectSummaries& summaries;
  const PairFilter& filter;
  bool same_filter;

  [[nodiscard]] bool stands(SlotPair pair) const {
    return same_filter && !summaries.changed(first_of(pair)) && !summaries.changed(second_of(pair));
  }
};

/// The work of one task. It walks its ranges of the known pairs and of the listed pairs side by side. It
/// writes its own ranges of `known_` and `selected_`. It writes the memories to be released into the part of
/// its range of `last_` that it has already passed.
class PairSelection::Walk {
 public:
  Walk(PairSelection& selection, const Given& given, Slice& slice)
      : selection_(selection),
        given_(given),
        slice_(slice),
        last_(slice.last_begin),
        listed_(slice.listed_begin) {}

  void run() {
    for (std::size_t index = slice_.begin; index < slice_.end; ++index) visit(index);
    drop_before(slice_.end < given_.pairs.size() ? given_.pairs[slice_.end] : no_pair);  // behind all others
  }

 private:
  [[nodiscard]] bool is_known(SlotPair pair) const {
    return last_ < slice_.last_end && selection_.last_[last_].pair == pair;
  }
  std::uint32_t next_listed(SlotPair pair) {
    if (listed_ == slice_.listed_end || given_.listed[listed_].pair != pair) return SelectedPair::none;
    return static_cast<std::uint32_t>(listed_++);
  }

  /// Drops the pairs below `end` that the broad phase no longer keeps.
  void drop_before(SlotPair end) {
    while (true) {
      SlotPair pair = end;
      if (last_ < slice_.last_end) pair = std::min(pair, selection_.last_[last_].pair);
      if (listed_ < slice_.listed_end) pair = std::min(pair, given_.listed[listed_].pair);
      if (pair == end) return;
      const std::uint32_t memory = is_known(pair) ? selection_.last_[last_++].memory : SelectedPair::none;
      drop({pair, SelectedPair::none, memory, next_listed(pair)});
    }
  }

  void visit(std::size_t index) {
    const SlotPair pair = given_.pairs[index];
    drop_before(pair);
    Known known{pair};
    if (is_known(pair)) known = selection_.last_[last_++];
    const SelectedPair selected{pair, static_cast<std::uint32_t>(index), known.memory, next_listed(pair)};
    if (!known.rests || !given_.stands(pair)) {
      known.fate = fate_of(pair, given_.summaries, given_.filter);
      known.rests = known.fate != Fate::tested && known.fate != Fate::frozen;
    }
    ++slice_.fates[static_cast<std::size_t>(known.fate)];
    if (known.fate != Fate::tested) {
      known.memory = SelectedPair::none;
      drop(selected);
    } else if (known.rests) {
      add_resting(selected);
    } else {
      add(selected);
    }
    selection_.known_[index] = known;
  }

  void add(const SelectedPair& selected) {
    selection_.selected_[slice_.selected_begin + slice_.selected++] = selected;
  }
  void add_resting(SelectedPair selected) {
    ++slice_.resting;
    if (selected.listed == SelectedPair::none) return;
    if (slice_.selected > 0) {
      SelectedPair& before = selection_.selected_[slice_.selected_begin + slice_.selected - 1];
      const auto row = [&](std::uint32_t listed) { return given_.listed[listed].row; };
      if (before.kind == SelectedPair::Kind::resting && before.listed + before.count == selected.listed &&
          row(before.listed) + before.count == row(selected.listed)) {
        ++before.count;
        return;
      }
    }
    selected.kind = SelectedPair::Kind::resting;
    add(selected);
  }
  void drop(SelectedPair selected) {
    if (selected.listed != SelectedPair::none) {
      selected.kind = SelectedPair::Kind::not_selected;
      add(selected);
    } else if (selected.memory != SelectedPair::none) {
      // The memory belongs to a pair of `last_` that the walk has passed, so there is a free entry for it.
      selection_.last_[slice_.last_begin + slice_.forgotten++].memory = selected.memory;
    }
  }

  PairSelection& selection_;
  const Given& given_;
  Slice& slice_;
  std::size_t last_;
  std::size_t listed_;
};

std::span<const SelectedPair> PairSelection::select(std::span<const SlotPair> pairs,
                                                    std::span<const ListedPair> listed,
                                                    const ObjectSummaries& summaries,
                                                    const PairFilter& filter, TaskPool& tasks,
                                                    StepStatistics& statistics) {
  for (const PairMemories::Index memory : temporary_) memories_.release(memory);
  temporary_.clear();
  last_.swap(known_);
  if (!summaries.new_slots().empty()) remap(summaries.new_slots());
  known_.resize(pairs.size());
  cut(pairs, listed);
  const bool same_filter = std::exchange(filter_version_, filter.version()) == filter.version();
  const Given given{pairs, listed, summaries, filter, same_filter};
  const auto select_slice = [&](unsigned, std::size_t index) { Walk(*this, given, slices_[index]).run(); };
  tasks.run(slices_.size(), std::ref(select_slice),
            {.nanoseconds = nanoseconds_each_selected * static_cast<double>(pairs.size())});
  validate(given);
  statistics.pairs_close = pairs.size();
  count(statistics);
  return std::span(selected_).first(gather());
}

/// Renames pairs by the new slots of their objects.
void PairSelection::remap(std::span<const std::uint32_t> new_slots) {
  std::size_t kept = 0;
  for (Known known : last_) {
    known.pair = remapped_pair(known.pair, new_slots);
    if (known.pair != no_pair)
      last_[kept++] = known;
    else if (known.memory != SelectedPair::none)
      memories_.release(known.memory);
  }
  last_.resize(kept);
}

/// Cuts the three lists into slices at the same pairs.
void PairSelection::cut(std::span<const SlotPair> pairs, std::span<const ListedPair> listed) {
  slices_.clear();
  Slice slice{};
  do {
    slice.end = std::min(slice.begin + pairs_of_slice, pairs.size());
    const bool is_last = slice.end == pairs.size();
    slice.last_end = is_last ? last_.size() : index_in(last_, pairs[slice.end]);
    slice.listed_end = is_last ? listed.size() : index_in(listed, pairs[slice.end]);
    slice.selected_begin = slice.begin + slice.listed_begin;
    slices_.push_back(slice);
    slice.begin = slice.end;
    slice.last_begin = slice.last_end;
    slice.listed_begin = slice.listed_end;
  } while (slice.begin < pairs.size());
  selected_.resize(std::max(selected_.size(), pairs.size() + listed.size()));
}

PairSelection::Fate PairSelection::fate_of(SlotPair pair, const ObjectSummaries& summaries,
                                           const PairFilter& filter) {
  const ObjectSummary& a = summaries[first_of(pair)];
  const ObjectSummary& b = summaries[second_of(pair)];
  if (a.hidden || b.hidden) return Fate::apart;
  if (!may_be_near(lower_distance(a.box, b.box), filter.reach(a, b)) &&
      !summaries.may_meet_on_way(pair, filter.swept_gap()))
    return Fate::apart;
  return a.frozen || b.frozen ? Fate::frozen : Fate::tested;
}

/// Joins the selections of all slices, and releases the memories of pairs that no report lists.
std::size_t PairSelection::gather() {
  std::size_t count = 0;
  for (const Slice& slice : slices_) {
    const auto from = selected_.begin() + static_cast<std::ptrdiff_t>(slice.selected_begin);
    std::copy_n(from, slice.selected, selected_.begin() + static_cast<std::ptrdiff_t>(count));
    count += slice.selected;
    for (std::size_t i = 0; i < slice.forgotten; ++i) memories_.release(last_[slice.last_begin + i].memory);
  }
  return count;
}

void PairSelection::count(StepStatistics& statistics) const {
  statistics.pairs_apart = 0;
  for (const Slice& slice : slices_)
    statistics.pairs_apart += slice.fates[static_cast<std::size_t>(Fate::apart)];
  for (const Slice& slice : slices_) statistics.pairs_unchanged += slice.resting;
}

#ifdef GRAZE_VALIDATE
/// Throws if what is known of a pair at rest differs from what its objects say.
void PairSelection::validate(const Given& given) {
  for (const Known& known : known_) {
    if (!known.rests) continue;
    const ObjectSummary& a = given.summaries[first_of(known.pair)];
    const ObjectSummary& b = given.summaries[second_of(known.pair)];
    bool holds = given.filter.verdict(a, b) == PairVerdict::tested &&
                 known.fate == fate_of(known.pair, given.summaries, given.filter);
    if (known.fate == Fate::tested) {
      const PairMemory& memory = memories_[known.memory];
      holds = holds && memory.version_a == a.version && memory.version_b == b.version &&
              memory.rules_version == given.filter.rules_version() &&
              memory.groups_version == given.filter.groups(a, b).version;
    }
    if (!holds) throw std::logic_error("graze validator: a pair rests of which something has changed");
  }
}
#else
void PairSelection::validate(const Given&) {}
#endif

PairMemory& PairSelection::memory_of(const SelectedPair& selected) {
  const PairMemories::Index memory =
      selected.memory == SelectedPair::none ? memories_.acquire() : selected.memory;
  if (selected.close_index == SelectedPair::none)
    temporary_.push_back(memory);
  else
    known_[selected.close_index].memory = memory;
  return memories_[memory];
}

void PairSelection::forget(const SelectedPair& selected) {
  if (selected.memory != SelectedPair::none) memories_.release(selected.memory);
}

void PairSelection::reserve(std::size_t pairs, const PairMemoryRoom& room) {
  memories_.reserve(pairs, room);
  known_.reserve(pairs);
  last_.reserve(pairs);
  temporary_.reserve(pairs);
  selected_.reserve(2 * pairs);
  slices_.reserve(pairs / pairs_of_slice + 1);
}

std::size_t PairSelection::byte_count() const {
  return memories_.byte_count() + bytes_of(known_) + bytes_of(last_) + bytes_of(temporary_) +
         bytes_of(selected_) + bytes_of(slices_);
}

}  // namespace graze
