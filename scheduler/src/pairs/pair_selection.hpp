#pragma once

#include <array>
#include <cstdint>
#include <graze/report.hpp>
#include <limits>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "core/base/prefetch.hpp"
#include "objects/object_summary.hpp"
#include "pairs/pair_filter.hpp"
#include "pairs/pair_memory.hpp"

namespace graze {

/// A pair in the last report.
struct ListedPair {
  SlotPair pair = 0;
  std::uint32_t row = 0;  ///< in the report
};

/// One pair that needs a job, or several pairs at rest.
struct SelectedPair {
  enum class Kind : std::uint8_t {
    tested,   ///< passes the filters, may be near or meet on the way, and neither object is frozen
    resting,  ///< `count` such pairs in a row that the last report lists, and is to list again as they are
    not_selected,  ///< otherwise, but listed in the last report
  };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  SlotPair pair = 0;
  std::uint32_t close_index = none;  ///< among the pairs of the broad phase
  std::uint32_t memory = none;
  std::uint32_t listed = none;  ///< index among those that the last report lists, the first of several
  std::uint16_t count = 1;
  Kind kind = Kind::tested;
};

/// Selects the pairs of the broad phase that have to be tested, and keeps their memories. The result for a
/// pair stays valid until one of its objects or the filter changes. Until then a step reads only what is
/// known of the pair, not its objects. Stepping thread only.
class PairSelection {
 public:
  /// Goes through the pairs of the broad phase, which the filters let pass, and those of the last report.
  /// Both ascend by their objects' current slots. The result ascends too and is valid until the next call.
  /// Counts the omitted pairs by reason, and the pairs at rest, in `statistics`. A pair that the next call
  /// does not ask for is forgotten.
  std::span<const SelectedPair> select(std::span<const SlotPair> pairs, std::span<const ListedPair> listed,
                                       const ObjectSummaries& summaries, const PairFilter& filter,
                                       TaskPool& tasks, StepStatistics& statistics);

  /// The memory of a selected pair, which is new if the pair had none. It keeps its address until the call
  /// after the next.
  PairMemory& memory_of(const SelectedPair& selected);
  /// Forgets a pair of kind `not_selected` whose memory is not needed.
  void forget(const SelectedPair& selected);
  /// Lets a tested pair rest until something changes, since its last answer holds for the current positions.
  void let_rest(const SelectedPair& selected) { known_[selected.close_index].rests = true; }
  /// Prefetches the memory that `memory_of` will return.
  void prefetch(const SelectedPair& selected) {
    if (selected.memory != SelectedPair::none) graze::prefetch(&memories_[selected.memory].version_a);
  }

  /// Reserves memory for that many pairs of the broad phase.
  void reserve(std::size_t pairs, const PairMemoryRoom& room);
  void reserve_for_solids() { memories_.reserve_for_solids(); }
  /// The bytes held. Of the fronts it counts only reserved memory.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  enum class Fate : std::uint8_t { tested, apart, frozen };
  static constexpr std::size_t fate_count = 3;

  struct Known {
    SlotPair pair = 0;
    std::uint32_t memory = SelectedPair::none;
    Fate fate = Fate::tested;
    bool rests = false;  ///< so it is until an object or the filter changes
  };
  /// A range of the pairs and the results of the task that processes it.
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
  static Fate fate_of(SlotPair pair, const ObjectSummaries& summaries, const PairFilter& filter);
  std::size_t gather();
  void count(StepStatistics& statistics) const;
  void validate(const Given& given);

  PairMemories memories_;
  std::vector<Known> known_;  ///< of the broad phase's pairs
  std::vector<Known> last_;   ///< of those of the call before
  std::vector<PairMemories::Index>
      temporary_;  ///< of pairs whose loose boxes do not meet, until the next call
  std::uint64_t filter_version_ = 0;
  std::vector<SelectedPair> selected_;
  std::vector<Slice> slices_;
};

/// Whether a pair may be within `reach` if its boxes have this lower_distance. Boxes that meet are near at
/// any reach.
inline bool may_be_near(double lower, double reach) {
  return lower < reach || !(lower > 0);
}

}  // namespace graze
