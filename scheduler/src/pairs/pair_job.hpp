#pragma once

#include <algorithm>
#include <cstdint>
#include <graze/report.hpp>
#include <span>

#include "base/access.hpp"
#include "base/slot_pair.hpp"
#include "core/base/prefetch.hpp"
#include "core/search/large_pair.hpp"
#include "objects/object.hpp"
#include "pairs/pair_filter.hpp"
#include "pairs/pair_memory.hpp"

namespace graze {

inline bool is_contact(PairPhase phase) {
  return phase == PairPhase::began || phase == PairPhase::touching;
}

/// The work of one step for one pair.
struct PairJob {
  enum class Task : std::uint8_t {
    detect,       ///< test the pair
    end,          ///< filtered out while in contact: find its distance once more
    repeat_last,  ///< an object is frozen: repeat the last values
    unchanged,    ///< nothing has moved since the last answer: repeat it
  };
  Task task = Task::detect;
  bool allowed = true;      ///< whether the filters allow the pair
  bool is_swept = false;    ///< whether its objects may meet between the last step and this one
  bool met_on_way = false;  ///< they may have, by a sweep of this step
  SlotPair slots = 0;
  Object* a = nullptr;
  Object* b = nullptr;
  const PairReport* last = nullptr;  ///< the row in the previous report. It is null if there was none
  PairMemory* memory = nullptr;      ///< tasks use `memory_to_write`
  PairThresholds thresholds;
  PairGroups groups;

  [[nodiscard]] PairMemory& memory_to_write() const {
    require_write(StepData::pairs, this);
    return *memory;
  }
  /// Whether it is an object with itself.
  [[nodiscard]] bool is_of_self() const { return a == b; }
  [[nodiscard]] bool is_tested() const { return task == Task::detect || task == Task::end; }
  /// Whether both surfaces are so large that a search of the pair is cut for several workers.
  [[nodiscard]] bool is_large() const {
    return std::min(a->surface().mesh().vertex_count(), b->surface().mesh().vertex_count()) >=
           LargePair::least_vertex_count;
  }
  /// Whether the last row of the pair is of a mesh that was replaced since.
  [[nodiscard]] bool speaks_of_replaced() const { return a->replaced != nullptr || b->replaced != nullptr; }
  [[nodiscard]] bool was_in_contact() const { return last != nullptr && is_contact(last->phase); }
};

/// Where one thread walks all jobs, fetches what it reads soon of the objects of a later one.
template <typename... Member>
void prefetch_ahead(std::span<const PairJob> jobs, std::size_t index, Member Object::*... members) {
  constexpr std::size_t ahead = 8;
  if (index + ahead >= jobs.size()) return;
  for (const Object* const object : {jobs[index + ahead].a, jobs[index + ahead].b})
    (prefetch(&(object->*members)), ...);
}

/// Rows of the last report that this report repeats before the row of a job. They are rows of pairs at rest,
/// or the row of a pair that ends because one of its objects was removed.
struct LastRows {
  std::size_t job;
  std::uint32_t listed;  ///< the first, among the pairs that the last report lists
  std::uint32_t row;     ///< the first
  std::uint32_t count;
  bool ended = false;  ///< if true, `listed` is undefined
};

/// All jobs and repeated rows of a step, ordered by the slots of objects a and b.
struct PairList {
  std::span<const PairJob> jobs;
  std::span<const LastRows> last_rows;   ///< ascending by the job they stand before
  std::size_t pair_count = 0;            ///< of all pairs with a memory
  std::uint64_t region_pairs_swept = 0;  ///< which a work budget counts, too
};

}  // namespace graze
