#include "calls/object_ids.hpp"

#include <limits>
#include <utility>

namespace graze {
namespace {

// A place's state: the generation in the upper half, then its phase, whether the object is deformable, and
// the number of pins.
constexpr std::uint64_t phase_mask = std::uint64_t{3} << 30;
constexpr std::uint64_t absent = 0;                        ///< nobody's: its index may be given
constexpr std::uint64_t coming = std::uint64_t{1} << 30;   ///< given, its addition is not yet queued
constexpr std::uint64_t present = std::uint64_t{2} << 30;  ///< the id is good
constexpr std::uint64_t gone = std::uint64_t{3} << 30;     ///< removed, and pinned still
constexpr std::uint64_t deformable = std::uint64_t{1} << 29;
constexpr std::uint64_t pin_mask = deformable - 1;

std::uint32_t generation_of(std::uint64_t state) {
  return static_cast<std::uint32_t>(state >> 32);
}

bool is_present(std::uint64_t state, std::uint32_t generation) {
  return generation_of(state) == generation && (state & phase_mask) == present;
}

}  // namespace

ObjectId ObjectIds::give(std::shared_ptr<const Mesh> mesh, ObjectSettings settings) {
  const std::uint32_t index = places_.take();
  Place& place = places_[index];
  const std::uint32_t generation = generation_of(place.state.load(std::memory_order_relaxed)) + 1;
  const std::uint64_t kind = settings.motion == Motion::deformable ? deformable : 0;
  place.named.mesh = std::move(mesh);
  place.named.settings = std::move(settings);
  // Nobody pins what is coming, so a plain store takes nothing away.
  place.state.store(std::uint64_t{generation} << 32 | coming | kind, std::memory_order_relaxed);
  count_.fetch_add(1, std::memory_order_relaxed);
  return {index, generation};
}

void ObjectIds::take_back(ObjectId object) noexcept {
  count_.fetch_sub(1, std::memory_order_relaxed);
  empty(object.index, object.generation);
}

void ObjectIds::publish(ObjectId object) noexcept {
  std::atomic<std::uint64_t>& state = places_[object.index].state;
  std::uint64_t seen = state.load(std::memory_order_relaxed);
  // Release: who finds the id good finds what it names.
  while (generation_of(seen) == object.generation && (seen & phase_mask) == coming)
    if (state.compare_exchange_weak(seen, (seen & ~phase_mask) | present, std::memory_order_release,
                                    std::memory_order_relaxed))
      return;
}

bool ObjectIds::remove(ObjectId object) noexcept {
  std::atomic<std::uint64_t>& state = places_[object.index].state;
  std::uint64_t seen = state.load(std::memory_order_relaxed);
  while (is_present(seen, object.generation))
    if (state.compare_exchange_weak(seen, (seen & ~phase_mask) | gone, std::memory_order_relaxed)) {
      count_.fetch_sub(1, std::memory_order_relaxed);
      return true;
    }
  return false;
}

ObjectIds::Pin ObjectIds::pin(ObjectId object) noexcept {
  Place* const place = places_.find(object.index);
  if (place == nullptr) return {};
  std::uint64_t seen = place->state.load(std::memory_order_relaxed);
  // Acquire: what `give` wrote is visible; every change of the state since `publish` is a read-modify-write,
  // which keeps its release.
  while (is_present(seen, object.generation))
    if (place->state.compare_exchange_weak(seen, seen + 1, std::memory_order_acquire,
                                           std::memory_order_relaxed))
      return {*this, object.index};
  return {};
}

ObjectIds::Standing ObjectIds::standing(ObjectId object) const noexcept {
  const Place* const place = places_.find(object.index);
  if (place == nullptr) return Standing::stale;
  const std::uint64_t state = place->state.load(std::memory_order_relaxed);
  if (!is_present(state, object.generation)) return Standing::stale;
  return (state & deformable) != 0 ? Standing::deformable : Standing::posed;
}

void ObjectIds::unpin(std::uint32_t index) noexcept {
  Place& place = places_[index];
  // Release: what this thread read of the place was read before it is emptied; acquire, should it be the
  // last: so was what the others read.
  const std::uint64_t before = place.state.fetch_sub(1, std::memory_order_acq_rel);
  if ((before & phase_mask) == gone && (before & pin_mask) == 1) empty(index, generation_of(before));
}

/// Nobody else knows the place any more.
void ObjectIds::empty(std::uint32_t index, std::uint32_t generation) noexcept {
  Place& place = places_[index];
  place.named.mesh.reset();
  place.named.settings = {};
  place.named.spare_positions.clear(position_bytes_);
  place.named.binding.stands = false;
  place.lost.store(0, std::memory_order_relaxed);
  place.state.store(std::uint64_t{generation} << 32 | absent, std::memory_order_relaxed);
  // An index whose generations are used up is never given again.
  if (generation != std::numeric_limits<std::uint32_t>::max()) places_.give_back(index);
}

void ObjectIds::lose(std::uint32_t index, std::uint8_t lost) noexcept {
  places_[index].lost.fetch_or(lost, std::memory_order_relaxed);
  some_lost_.store(true, std::memory_order_release);
}

void ObjectIds::take_lost() noexcept {
  if (!some_lost_.load(std::memory_order_relaxed) || !some_lost_.exchange(false, std::memory_order_acquire))
    return;
  for (std::uint32_t index = 0; index < places_.made_count(); ++index) {
    Place* const place = places_.find(index);
    if (place == nullptr) continue;
    std::uint8_t lost = place->lost.exchange(0, std::memory_order_relaxed);
    if (place->named.binding.stands) lost &= static_cast<std::uint8_t>(~LostCalls::binding);
    if (lost == 0) continue;
    place->taken = lost;
    place->taken_generation = generation_of(place->state.load(std::memory_order_relaxed));
    some_taken_ = true;
  }
}

void ObjectIds::give_lost_back() noexcept {
  if (!std::exchange(some_taken_, false)) return;
  for (std::uint32_t index = 0; index < places_.made_count(); ++index) {
    Place* const place = places_.find(index);
    if (place == nullptr) continue;
    const std::uint8_t taken = std::exchange(place->taken, std::uint8_t{0});
    // An object that has gone loses nothing more. One whose removal was lost is there still.
    const bool is_there =
        generation_of(place->state.load(std::memory_order_relaxed)) == place->taken_generation;
    if (taken != 0 && is_there) lose(index, taken);
  }
}

}  // namespace graze
