#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <span>

#include "base/access.hpp"
#include "base/slot_pair.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"
#include "pairs/pair_memory.hpp"

namespace graze {

inline bool is_contact(PairPhase phase) {
  return phase == PairPhase::began || phase == PairPhase::touching;
}

/// What is to be done about one pair in this step.
struct PairJob {
  enum class Task : std::uint8_t {
    detect,       ///< look at it
    end,          ///< filtered out while in contact: its distance once more
    repeat_last,  ///< an object is frozen: the last values
    unchanged,    ///< nothing has moved since the last answer: it is this one's too
  };
  Task task = Task::detect;
  bool allowed = true;  ///< by the filters
  SlotPair slots = 0;
  Object* a = nullptr;
  Object* b = nullptr;
  const PairReport* last = nullptr;  ///< in the previous report; null where it was not listed
  PairMemory* memory = nullptr;      ///< for tasks through `memory_to_write`
  PairThresholds thresholds;

  [[nodiscard]] PairMemory& memory_to_write() const {
    require_write(StepData::pairs, this);
    return *memory;
  }
  [[nodiscard]] bool is_tested() const { return task == Task::detect || task == Task::end; }
  [[nodiscard]] bool was_in_contact() const { return last != nullptr && is_contact(last->phase); }
};

/// Rows of the last report that this one has too, before a job's: some that rest and stand as they are, or
/// one of which an object was removed, and which ends.
struct LastRows {
  std::size_t job;
  std::uint32_t listed;  ///< the first, among the pairs that the last report lists
  std::uint32_t row;     ///< the first
  std::uint32_t count;
  bool ended = false;  ///< then `listed` says nothing
};

/// What is to be done and said about the pairs of a scene, in the order of addition of a, then b.
struct PairList {
  std::span<const PairJob> jobs;
  std::span<const LastRows> last_rows;  ///< ascending by the job they stand before
  std::size_t pair_count = 0;           ///< of all pairs with a memory
};

}  // namespace graze
