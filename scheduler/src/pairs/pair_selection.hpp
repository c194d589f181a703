#pragma once

#include <array>
#include <cstdint>
#include <graze/report.hpp>
#include <limits>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "objects/object_summary.hpp"
#include "pairs/pair_filter.hpp"
#include "pairs/pair_memory.hpp"

namespace graze {

/// A pair that the last report lists.
struct ListedPair {
  SlotPair pair = 0;
  std::uint32_t row = 0;  ///< in the report
};

/// One pair of which something is to be said or done, or several that rest.
struct SelectedPair {
  enum class Kind : std::uint8_t {
    tested,   ///< passes the filters, may be near, and neither object is frozen
    resting,  ///< `count` such pairs in a row that the last report lists, and is to list again as they are
    not_selected,  ///< otherwise, but listed in the last report
  };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  SlotPair pair = 0;
  std::uint32_t close_index = none;  ///< among the pairs of the broad phase
  std::uint32_t memory = none;
  std::uint32_t listed = none;  ///< among those that the last report lists; of several the first
  std::uint16_t count = 1;
  Kind kind = Kind::tested;
};

/// Of the pairs that the broad phase keeps, those that have to be looked at, and their memories. What was
/// found of a pair stands until one of its objects or the filter changes: that costs a look at what is known
/// of the pair, and none at its objects. Stepping thread only.
class PairSelection {
 public:
  /// Goes through the pairs of the broad phase and those that the last report lists, both ascending by the
  /// places that objects have now. The answer ascends, and stands until the next call. Counts in
  /// `statistics` what was left out and why, and what rests. Pairs that are not asked for by the next call
  /// are forgotten.
  std::span<const SelectedPair> select(std::span<const SlotPair> pairs, std::span<const ListedPair> listed,
                                       const ObjectSummaries& summaries, const PairFilter& filter,
                                       TaskPool& tasks, StepStatistics& statistics);

  /// The memory of a selected pair, a new one where there was none. It stays in place until the call after
  /// the next.
  PairMemory& memory_of(const SelectedPair& selected);
  /// Forgets a pair that was not selected, in place of asking for its memory.
  void forget(const SelectedPair& selected);
  /// Has a pair that was to be looked at rest until something changes: its last answer is about what is there
  /// now.
  void let_rest(const SelectedPair& selected) { known_[selected.close_index].rests = true; }
  /// Brings nearer what `memory_of` will give.
  void prefetch(const SelectedPair& selected) {
    if (selected.memory != SelectedPair::none) __builtin_prefetch(&memories_[selected.memory].version_a);
  }

  /// Makes room for so many pairs that the broad phase keeps.
  void reserve(std::size_t pairs, const PairMemoryRoom& room);
  /// Of the fronts only what was reserved.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  enum class Fate : std::uint8_t { tested, fixed, layer, group, ignored, apart, frozen };
  static constexpr std::size_t fate_count = 7;

  struct Known {
    SlotPair pair = 0;
    std::uint32_t memory = SelectedPair::none;
    Fate fate = Fate::tested;
    bool rests = false;  ///< so it is until an object or the filter changes
  };
  /// A part of the pairs, and what one task finds in it.
  struct Slice {
    std::size_t begin, end;  ///< of the broad phase's pairs
    std::size_t last_begin, last_end;
    std::size_t listed_begin, listed_end;
    std::size_t selected_begin;
    std::size_t selected = 0;
    std::size_t forgotten = 0;
    std::uint64_t resting = 0;
    std::array<std::uint64_t, fate_count> fates{};
  };
  struct Given;
  class Walk;

  void remap(std::span<const std::uint32_t> new_slots);
  void cut(std::span<const SlotPair> pairs, std::span<const ListedPair> listed);
  static Fate fate_of(const ObjectSummary& a, const ObjectSummary& b, const PairFilter& filter);
  std::size_t gather();
  void count(StepStatistics& statistics) const;
  void validate(const Given& given);

  PairMemories memories_;
  std::vector<Known> known_;  ///< of the broad phase's pairs
  std::vector<Known> last_;   ///< of those of the call before
  std::vector<PairMemories::Index>
      temporary_;  ///< of pairs whose loose boxes do not meet; until the next call
  std::uint64_t filter_version_ = 0;
  std::vector<SelectedPair> selected_;
  std::vector<Slice> slices_;
};

/// Whether boxes so far apart, by lower_distance, leave a pair within `reach`. Boxes that meet do at any
/// reach.
inline bool may_be_near(double lower, double reach) {
  return lower < reach || !(lower > 0);
}

}  // namespace graze
