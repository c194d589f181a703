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

namespace graze {

/// What an object is bound to, as the calls made so far have it. Under Staging's lock of bindings, but that
/// anyone may ask whether it is.
struct Binding {
  std::atomic<bool> stands{false};
  PositionView view;
  BindPolicy policy = BindPolicy::every_step;
  std::uint64_t steps_before = 0;  ///< how many had taken up calls when it was made
};

/// What a scene's callers may know of an object; mesh and settings are unchanged while it is pinned.
struct NamedObject {
  std::shared_ptr<const Mesh> mesh;
  ObjectSettings settings;
  SparePositions spare_positions;
  Binding binding;
};

/// Says which calls about an object were lost for lack of memory. The bits themselves take none.
struct LostCalls {
  static constexpr std::uint8_t any = 1;      ///< one that is not taken up as it was made
  static constexpr std::uint8_t motion = 2;   ///< its positions may have changed: no promise about it holds
  static constexpr std::uint8_t binding = 4;  ///< the end of its binding
  static constexpr std::uint8_t removal = 8;  ///< its removal; the slot stays pinned until a step knows of it
};

/// Which ids name objects, answered and changed from any thread without a lock.
///
/// Each index has a slot that never moves. Its `state` holds, in one atomic word, the generation that uses
/// it, how far that one has come, and how many threads have it pinned. A pin is taken only of an object
/// that is there, and whoever lets go of the last pin of an object that is gone empties the slot: what a pin
/// shows is never changed under it, and nobody waits. The index is given again after that.
class ObjectIds {
 public:
  /// Keeps a named object in place. It may be removed meanwhile.
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
    /// Leaves it pinned until its lost removal has been visited.
    void keep() noexcept { ids_ = nullptr; }

   private:
    ObjectIds* ids_ = nullptr;
    std::uint32_t index_ = 0;
  };

  /// A new id, which is not yet good.
  [[nodiscard]] ObjectId allocate(std::shared_ptr<const Mesh> mesh, ObjectSettings settings);
  /// Takes an id back that was not made good: nobody knows it.
  void cancel(ObjectId object) noexcept;
  /// Makes it good; nothing where it is or was already.
  void publish(ObjectId object) noexcept;
  /// Ends it. False where another call did so first. The caller has it pinned.
  [[nodiscard]] bool remove(ObjectId object) noexcept;

  /// Empty where the id names nothing now.
  [[nodiscard]] Pin pin(ObjectId object) noexcept;
  /// What pin would say, for less.
  enum class Standing : std::uint8_t { stale, deformable, posed };
  [[nodiscard]] Standing standing(ObjectId object) const noexcept;

  /// Notes what was lost about an object that is pinned.
  void lose(std::uint32_t index, std::uint8_t lost) noexcept;
  /// Takes what was lost until now for a step, which visits it after the calls that it takes up. Staging's
  /// lock is held, as it is where the end of a binding is lost: a binding that stands now was made later.
  void collect_lost() noexcept;
  /// The next step takes again what was not visited.
  void return_lost() noexcept;
  /// Calls `visit(object, lost)` for what was taken of each object; it clears the bits that are done
  /// with. Where a visit throws, the others are there still. Stepping thread only.
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

  /// Ids given and not removed.
  [[nodiscard]] std::size_t count() const noexcept { return count_.load(std::memory_order_relaxed); }
  void reserve(std::size_t count) { slots_.reserve(count); }
  /// A buffer for a copy of the positions of an object that is pinned.
  [[nodiscard]] SparePositions::Loan lend_positions(NamedObject& object, bool in_double) {
    return object.spare_positions.lend(object.mesh->vertex_count(), in_double, position_bytes_);
  }

  /// Of all places, and of all buffers of positions, lent or kept.
  [[nodiscard]] std::size_t byte_count() const noexcept {
    return slots_.byte_count() + position_bytes_.load(std::memory_order_relaxed);
  }

 private:
  struct Slot {
    std::atomic<std::uint64_t> state{0};
    std::atomic<std::uint8_t> lost{0};  ///< LostCalls about the object that is there
    std::uint8_t collected = 0;         ///< and for the step at hand: the stepping thread's, as what follows
    std::uint32_t collected_generation = 0;  ///< of the object of which that was lost
    NamedObject named;
  };
  void unpin(std::uint32_t index) noexcept;
  void empty(std::uint32_t index, std::uint32_t generation) noexcept;

  SparePositions::ByteCount position_bytes_{0};  ///< goes after the places, whose buffers are counted in it
  LockFreePool<Slot> slots_;
  std::atomic<std::size_t> count_{0};
  std::atomic<bool> some_lost_{false};
  bool some_collected_ = false;
};

}  // namespace graze
