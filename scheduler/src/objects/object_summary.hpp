#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "core/base/bytes_of.hpp"
#include "objects/filter_traits.hpp"
#include "objects/object.hpp"
#include "objects/swept_objects.hpp"

namespace graze {

/// The data of an object that the pair table needs for each of its pairs.
struct ObjectSummary : FilterTraits {
  Box box;  ///< Object::box
  double margin = 0;
  /// The largest distance by which a side of the box has moved since the step before.
  double motion = 0;
  std::uint64_t serial = 0;
  std::uint64_t version = 0;  ///< of its surface
  std::uint16_t kind = 0;
  bool frozen = false;
  bool unread = false;
  bool hidden = false;     ///< all of its faces are
  bool moved = false;      ///< the box is not that of the step before
  bool read_late = false;  ///< the box has changed since the refresh
};

/// How an object moves in a step, in a scene where an object is swept.
struct SweptSummary {
  MovingBox box;       ///< on its way to where it is now
  bool swept = false;  ///< ObjectSettings::swept
  bool moves = false;
};

/// The summaries of all objects in one array, in the order of addition. Stepping thread only.
class ObjectSummaries {
 public:
  /// Updates all summaries. The box of a new object counts as unmoved. `insertions` is
  /// ObjectStore::insertions.
  void refresh(std::span<const std::unique_ptr<Object>> objects, TaskPool& tasks,
               std::uint64_t insertions = 0);
  /// Updates the summaries of objects that were read after the last full refresh.
  void refresh(std::span<Object* const> read_late);

  [[nodiscard]] std::span<const ObjectSummary> all() const { return summaries_; }
  [[nodiscard]] const ObjectSummary& operator[](std::uint32_t slot) const { return summaries_[slot]; }
  /// Takes up how all objects move in this step, which are those of the last refresh.
  void take_up_sweeps(std::span<const std::unique_ptr<Object>> objects, const SweptObjects& swept);
  /// How objects move. It is empty if none is swept.
  [[nodiscard]] std::span<const SweptSummary> sweeps() const { return sweeps_; }
  /// The box that holds an object throughout this step.
  [[nodiscard]] Box whole_box(std::uint32_t slot) const {
    return sweeps_.empty() || !sweeps_[slot].moves ? summaries_[slot].box : sweeps_[slot].box.whole();
  }
  /// Whether a pair is swept, and its objects may come within `gap` of each other on the way.
  [[nodiscard]] bool may_meet_on_way(SlotPair pair, double gap) const;
  /// The slot of an object.
  [[nodiscard]] std::uint32_t slot_of(const Object& object) const;
  /// The slot of the object of a serial, or no_slot.
  [[nodiscard]] std::uint32_t find_slot(std::uint64_t serial) const;
  /// The new slot of each object that existed before the last refresh, or no_slot for a removed one. It is
  /// empty if no slot has changed. New objects get the last slots, or those between that are free.
  [[nodiscard]] std::span<const std::uint32_t> new_slots() const { return new_slots_; }
  [[nodiscard]] bool some_unread() const { return some_unread_; }
  /// Whether an object may have changed since the refresh before, or is unread. It means nothing for new
  /// objects.
  [[nodiscard]] bool changed(std::uint32_t slot) const { return changed_[slot] != 0; }
  /// Reserves memory for the sweeps of that many objects.
  void reserve_for_sweeps(std::size_t objects) { sweeps_.reserve(objects); }
  /// Reserves memory for that many objects.
  void reserve(std::size_t objects) {
    summaries_.reserve(objects);
    arrivals_.reserve(objects);
    new_slots_.reserve(objects);
    changed_.reserve(objects);
  }
  [[nodiscard]] std::size_t byte_count() const {
    return bytes_of(summaries_) + bytes_of(arrivals_) + bytes_of(new_slots_) + bytes_of(changed_) +
           bytes_of(sweeps_);
  }

 private:
  /// Removes the summaries of removed objects and adds those of new ones.
  void update_slots(std::span<const std::unique_ptr<Object>> objects, std::uint64_t insertions);

  std::vector<ObjectSummary> summaries_;
  std::vector<std::uint64_t> arrivals_;  ///< Object::arrival of each
  std::vector<std::uint32_t> new_slots_;
  std::vector<std::uint8_t> changed_;  ///< in one array, since every pair reads it for both objects
  std::vector<SweptSummary> sweeps_;   ///< in an array of their own, for the scenes that have them
  bool some_unread_ = false;
  std::uint64_t insertions_ = 0;  ///< of the last refresh
};

}  // namespace graze
