#include "calls/object_ids.hpp"

#include <limits>
#include <utility>

namespace graze {
namespace {

// A slot's state: the generation in the upper half, then its phase, whether the object is deformable, and
// the number of pins.
constexpr std::uint64_t phase_mask = std::uint64_t{3} << 30;
constexpr std::uint64_t absent = 0;                         ///< free: its index may be allocated
constexpr std::uint64_t reserved = std::uint64_t{1} << 30;  ///< allocated, but the addition is not queued yet
constexpr std::uint64_t present = std::uint64_t{2} << 30;   ///< the id is valid
constexpr std::uint64_t gone = std::uint64_t{3} << 30;      ///< removed, and pinned still
constexpr std::uint64_t deformable = std::uint64_t{1} << 29;
constexpr std::uint64_t pin_mask = deformable - 1;

std::uint32_t generation_of(std::uint64_t state) {
  return static_cast<std::uint32_t>(state >> 32);
}

bool is_present(std::uint64_t state, std::uint32_t generation) {
  return generation_of(state) == generation && (state & phase_mask) == present;
}

}  // namespace

ObjectId ObjectIds::allocate(std::shared_ptr<const Mesh> mesh, ObjectSettings settings) {
  const std::uint32_t index = slots_.acquire();
  Slot& slot = slots_[index];
  const std::uint32_t generation = generation_of(slot.state.load(std::memory_order_relaxed)) + 1;
  const std::uint64_t kind = settings.motion == Motion::deformable ? deformable : 0;
  slot.named.mesh.begin(std::move(mesh));
  slot.named.settings = std::move(settings);
  // Nobody pins a reserved slot, so a plain store loses no pin.
  slot.state.store(std::uint64_t{generation} << 32 | reserved | kind, std::memory_order_relaxed);
  count_.fetch_add(1, std::memory_order_relaxed);
  return {index, generation};
}

void ObjectIds::cancel(ObjectId object) noexcept {
  count_.fetch_sub(1, std::memory_order_relaxed);
  empty(object.index, object.generation);
}

void ObjectIds::publish(ObjectId object) noexcept {
  std::atomic<std::uint64_t>& state = slots_[object.index].state;
  std::uint64_t seen = state.load(std::memory_order_relaxed);
  // Release: a thread that finds the id valid sees the object's data.
  while (generation_of(seen) == object.generation && (seen & phase_mask) == reserved)
    if (state.compare_exchange_weak(seen, (seen & ~phase_mask) | present, std::memory_order_release,
                                    std::memory_order_relaxed))
      return;
}

bool ObjectIds::remove(ObjectId object) noexcept {
  std::atomic<std::uint64_t>& state = slots_[object.index].state;
  std::uint64_t seen = state.load(std::memory_order_relaxed);
  while (is_present(seen, object.generation))
    if (state.compare_exchange_weak(seen, (seen & ~phase_mask) | gone, std::memory_order_relaxed)) {
      count_.fetch_sub(1, std::memory_order_relaxed);
      return true;
    }
  return false;
}

ObjectIds::Pin ObjectIds::pin(ObjectId object) noexcept {
  Slot* const slot = slots_.find(object.index);
  if (slot == nullptr) return {};
  std::uint64_t seen = slot->state.load(std::memory_order_relaxed);
  // Acquire: what `allocate` wrote is visible. Every change of the state since `publish` is a
  // read-modify-write, which keeps its release.
  while (is_present(seen, object.generation))
    if (slot->state.compare_exchange_weak(seen, seen + 1, std::memory_order_acquire,
                                          std::memory_order_relaxed))
      return {*this, object.index};
  return {};
}

ObjectIds::Standing ObjectIds::standing(ObjectId object) const noexcept {
  const Slot* const slot = slots_.find(object.index);
  if (slot == nullptr) return Standing::stale;
  const std::uint64_t state = slot->state.load(std::memory_order_relaxed);
  if (!is_present(state, object.generation)) return Standing::stale;
  return (state & deformable) != 0 ? Standing::deformable : Standing::posed;
}

void ObjectIds::unpin(std::uint32_t index) noexcept {
  Slot& slot = slots_[index];
  // Release: this thread's reads come before the slot is emptied. Acquire, for the last pin: so do all other
  // threads' reads.
  const std::uint64_t before = slot.state.fetch_sub(1, std::memory_order_acq_rel);
  if ((before & phase_mask) == gone && (before & pin_mask) == 1) empty(index, generation_of(before));
}

/// Empties a slot that no other thread uses any more.
void ObjectIds::empty(std::uint32_t index, std::uint32_t generation) noexcept {
  Slot& slot = slots_[index];
  slot.named.mesh.begin(nullptr);
  slot.named.settings = {};
  slot.named.spare_positions.clear(position_bytes_);
  slot.named.binding.stands = false;
  slot.lost.store(0, std::memory_order_relaxed);
  slot.state.store(std::uint64_t{generation} << 32 | absent, std::memory_order_relaxed);
  // An index whose generations are used up is never allocated again.
  if (generation != std::numeric_limits<std::uint32_t>::max()) slots_.release(index);
}

void ObjectIds::lose(std::uint32_t index, std::uint8_t lost) noexcept {
  slots_[index].lost.fetch_or(lost, std::memory_order_relaxed);
  some_lost_.store(true, std::memory_order_release);
}

void ObjectIds::collect_lost() noexcept {
  if (!some_lost_.load(std::memory_order_relaxed) || !some_lost_.exchange(false, std::memory_order_acquire))
    return;
  for (std::uint32_t index = 0; index < slots_.made_count(); ++index) {
    Slot* const slot = slots_.find(index);
    if (slot == nullptr) continue;
    std::uint8_t lost = slot->lost.exchange(0, std::memory_order_relaxed);
    if (slot->named.binding.stands) lost &= static_cast<std::uint8_t>(~LostCalls::binding);
    if (lost == 0) continue;
    slot->collected = lost;
    slot->collected_generation = generation_of(slot->state.load(std::memory_order_relaxed));
    some_collected_ = true;
  }
}

void ObjectIds::return_lost() noexcept {
  if (!std::exchange(some_collected_, false)) return;
  for (std::uint32_t index = 0; index < slots_.made_count(); ++index) {
    Slot* const slot = slots_.find(index);
    if (slot == nullptr) continue;
    const std::uint8_t collected = std::exchange(slot->collected, std::uint8_t{0});
    // A removed object has nothing more to lose. One whose removal was lost still exists.
    const bool is_there =
        generation_of(slot->state.load(std::memory_order_relaxed)) == slot->collected_generation;
    if (collected != 0 && is_there) lose(index, collected);
  }
}

}  // namespace graze
