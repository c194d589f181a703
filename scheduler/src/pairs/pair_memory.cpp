#include "pairs/pair_memory.hpp"

#include <memory>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// This many memories reserve room for their fronts when they are made, half a MiB in all. Which pair gets
/// which memory, and so when a memory first needs room, is a matter of chance. For more pairs `reserve` makes
/// room.
constexpr std::size_t with_room_at_once = 512;

}  // namespace

PairMemories::Index PairMemories::acquire() {
  if (free_.empty()) {
    memories_.emplace_back();
    if (memories_.size() <= with_room_at_once) make_room(memories_.back(), {leaf_pairs_of_front, 0});
    return static_cast<Index>(memories_.size() - 1);
  }
  const Index index = free_.back();
  free_.pop_back();
  return index;
}

void PairMemories::release(Index index) {
  memories_[index].forget();
  free_.push_back(index);
}

void PairMemories::reserve(std::size_t pairs, const PairMemoryRoom& room) {
  free_.reserve(pairs);
  for (std::size_t index = memories_.size(); index < pairs; ++index) {
    memories_.emplace_back();
    free_.push_back(static_cast<Index>(index));
  }
  for (PairMemory& memory : memories_) make_room(memory, room);
}

void PairMemories::make_room(PairMemory& memory, const PairMemoryRoom& room) {
  LeafFront& front = memory.front;
  reserved_bytes_ -= front.byte_count();
  front.leaves.reserve(room.leaf_pairs);
  if (room.features > 0) {
    if (front.near == nullptr) front.near = std::make_unique<NearList>();
    front.near->pairs.reserve(room.features);
  }
  if (is_for_solids_ && front.last_inside == nullptr) front.last_inside = std::make_unique<LastInside>();
  reserved_bytes_ += front.byte_count();
}

void PairMemories::reserve_for_solids() {
  if (std::exchange(is_for_solids_, true)) return;
  for (PairMemory& memory : memories_) make_room(memory, {});
}

std::size_t PairMemories::byte_count() const {
  return memories_.size() * sizeof(PairMemory) + reserved_bytes_ + bytes_of(free_);
}

}  // namespace graze
