#pragma once

#include <cstdint>
#include <graze/report.hpp>

#include "access.hpp"
#include "object_store.hpp"
#include "pair_filter.hpp"
#include "pair_memory.hpp"

namespace graze {

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
  Object* a = nullptr;
  Object* b = nullptr;
  const PairReport* last = nullptr;  ///< in the previous report; null where it was not listed
  PairMemory* memory = nullptr;      ///< for tasks through `memory_to_write`
  PairThresholds thresholds;

  [[nodiscard]] PairMemory& memory_to_write() const {
    require_write(StepData::pairs, this);
    return *memory;
  }
  [[nodiscard]] bool is_looked_at() const { return task == Task::detect || task == Task::end; }
  [[nodiscard]] bool was_in_contact() const {
    return last != nullptr && (last->phase == PairPhase::began || last->phase == PairPhase::touching);
  }
};

}  // namespace graze
