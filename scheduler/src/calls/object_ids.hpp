#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/settings.hpp>
#include <memory>
#include <utility>

#include "base/lock_free_pool.hpp"
#include "base/spare_positions.hpp"
#include "calls/current_mesh.hpp"

namespace graze {

/// The memory to which an object is bound, by the calls made so far. Staging's lock of bindings guards it,
/// but any thread may read `stands`.
struct Binding {
  std::atomic<bool> stands{false};
  PositionView view;
  BindPolicy policy = BindPolicy::every_step;
  std::uint64_t steps_before = 0;  ///< how many steps had collected calls when it was made
};

/// The data of an object that callers may ask for. Settings do not change while the object is pinned.
struct NamedObject {
  CurrentMesh mesh;
  ObjectSettings settings;
  SparePositions spare_positions;
  Binding binding;
};

/// Bits that say which calls about an object were lost for lack of memory. The bits need no memory
/// themselves.
struct LostCalls {
  static constexpr std::uint8_t any = 1;      ///< a call that is not applied as it was made
  static constexpr std::uint8_t motion = 2;   ///< its positions may have changed: no promise about it holds
  static constexpr std::uint8_t binding = 4;  ///< the end of its binding
  static constexpr std::uint8_t removal = 8;  ///< its removal. The slot stays pinned until a step knows of it
};

/// The ids of objects. Any thread may query and change them without a lock.
///
/// Each index has a slot that never moves. The slot's `state` is one atomic word. It holds the generation
/// that uses the slot, its phase, and how many threads have pinned it. Only an object that exists can be
/// pinned. Whoever releases the last pin of a removed object empties its slot, and the index becomes free
/// after that. So of a pinned object only the mesh and the binding may change, and nobody waits.
class ObjectIds {
 public:
  /// Keeps an object's data valid. The object may be removed meanwhile.
  class Pin {
   public:
    Pin() = default;
    Pin(ObjectIds& ids, std::uint32_t index) : ids_(&ids), index_(index) {}
    Pin(Pin&& other) noexcept : ids_(std::exchange(other.ids_, nullptr)), index_(other.index_) {}
    Pin& operator=(Pin&&) = delete;
    ~Pin() {
      if (ids_ != nullptr) ids_->unpin(index_);
    }
    [[nodiscard]] explicit operator bool() const { return ids_ != nullptr; }
    [[nodiscard]] NamedObject& operator*() const { return ids_->slots_[index_].named; }
    [[nodiscard]] NamedObject* operator->() const { return &**this; }
    /// Leaves the object pinned until its lost removal has been visited.
    void keep() noexcept { ids_ = nullptr; }

   private:
    ObjectIds* ids_ = nullptr;
    std::uint32_t index_ = 0;
  };

  /// Allocates a new id, which is not valid before `publish`.
  [[nodiscard]] ObjectId allocate(std::shared_ptr<const Mesh> mesh, ObjectSettings settings);
  /// Frees an id that was not published, so that nobody knows it.
  void cancel(ObjectId object) noexcept;
  /// Makes an id valid. Does nothing if it is or was valid already.
  void publish(ObjectId object) noexcept;
  /// Makes an id invalid. Returns false if another call did so first. The caller has pinned the object.
  [[nodiscard]] bool remove(ObjectId object) noexcept;

  /// Pins an object. The pin is empty if the id names nothing now.
  [[nodiscard]] Pin pin(ObjectId object) noexcept;
  /// Says whether an id names an object and of which kind. It is cheaper than a pin.
  enum class Standing : std::uint8_t { stale, deformable, posed };
  [[nodiscard]] Standing standing(ObjectId object) const noexcept;

  /// Notes lost calls about a pinned object.
  void lose(std::uint32_t index, std::uint8_t lost) noexcept;
  /// Collects the lost calls for a step, which visits them after the other calls. Staging's lock is held, as
  /// it is when the end of a binding is lost. So a binding that stands now was made after that loss.
  void collect_lost() noexcept;
  /// Leaves what was not visited for the next step.
  void return_lost() noexcept;
  /// Calls `visit(object, lost)` for the collected losses of each object. The visitor clears the bits that it
  /// has handled. If a visit throws, the remaining ones stay. Stepping thread only.
  template <typename Visit>
  void visit_lost(const Visit& visit) {
    if (!some_collected_) return;
    for (std::uint32_t index = 0; index < slots_.made_count(); ++index) {
      Slot* const slot = slots_.find(index);
      if (slot == nullptr || slot->collected == 0) continue;
      const bool is_removed = (slot->collected & LostCalls::removal) != 0;
      visit(ObjectId{index, slot->collected_generation}, slot->collected);
      if (is_removed) unpin(index);
    }
    some_collected_ = false;
  }

  /// The number of ids allocated and not removed.
  [[nodiscard]] std::size_t count() const noexcept { return count_.load(std::memory_order_relaxed); }
  void reserve(std::size_t count) { slots_.reserve(count); }
  /// Lends a buffer for a copy of a pinned object's positions.
  [[nodiscard]] SparePositions::Loan lend_positions(NamedObject& object, std::size_t count, bool in_double) {
    return object.spare_positions.lend(count, in_double, position_bytes_);
  }

  /// The bytes of all slots and of all buffers of positions, lent or kept.
  [[nodiscard]] std::size_t byte_count() const noexcept {
    return slots_.byte_count() + position_bytes_.load(std::memory_order_relaxed);
  }

 private:
  struct Slot {
    std::atomic<std::uint64_t> state{0};
    std::atomic<std::uint8_t> lost{0};  ///< LostCalls about the present object
    std::uint8_t collected =
        0;  ///< the losses for the current step. This and the rest belong to the stepping thread
    std::uint32_t collected_generation = 0;  ///< the generation of that object
    NamedObject named;
  };
  void unpin(std::uint32_t index) noexcept;
  void empty(std::uint32_t index, std::uint32_t generation) noexcept;

  SparePositions::ByteCount position_bytes_{0};  ///< outlives the slots, whose buffers it counts
  LockFreePool<Slot> slots_;
  std::atomic<std::size_t> count_{0};
  std::atomic<bool> some_lost_{false};
  bool some_collected_ = false;
};

}  // namespace graze
