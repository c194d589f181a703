#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace graze {

/// A pair of objects as one number: the slot of each object, the lower first. An object's slot is its index
/// in the order of addition. The numbers ascend as (first, second) do.
using SlotPair = std::uint64_t;

constexpr SlotPair pair_of(std::uint32_t one, std::uint32_t other) {
  return (SlotPair{std::min(one, other)} << 32U) | std::max(one, other);
}
constexpr std::uint32_t first_of(SlotPair pair) {
  return static_cast<std::uint32_t>(pair >> 32U);
}
constexpr std::uint32_t second_of(SlotPair pair) {
  return static_cast<std::uint32_t>(pair);
}

/// The slot of an object that is gone, and a pair in which an object is gone.
constexpr std::uint32_t no_slot = ~std::uint32_t{0};
constexpr SlotPair no_pair = ~SlotPair{0};

/// The pair in new slots: the object in slot i moves to `new_slots[i]`. Returns no_pair where an object is
/// gone. Objects keep their order, and so do pairs.
inline SlotPair remapped_pair(SlotPair pair, std::span<const std::uint32_t> new_slots) {
  const std::uint32_t first = new_slots[first_of(pair)];
  const std::uint32_t second = new_slots[second_of(pair)];
  return first == no_slot || second == no_slot ? no_pair : pair_of(first, second);
}

/// Moves the entry of slot i to `new_slots[i]` and drops those of no_slot, so that there are `count`. Entries
/// of new slots are undefined. Without `new_slots` all stay, and new slots are the last.
template <typename Entry>
void renumber(std::vector<Entry>& entries, std::span<const std::uint32_t> new_slots, std::size_t count) {
  entries.resize(std::max(entries.size(), count));
  // Slots ascend before and after. So an entry that moves down never meets one that has still to move.
  // Neither does one that moves up, where the highest moves first.
  for (std::uint32_t slot = 0; slot < new_slots.size(); ++slot)
    if (new_slots[slot] < slot) entries[new_slots[slot]] = std::move(entries[slot]);
  for (auto slot = static_cast<std::uint32_t>(new_slots.size()); slot-- > 0;)
    if (new_slots[slot] != no_slot && new_slots[slot] > slot)
      entries[new_slots[slot]] = std::move(entries[slot]);
  entries.resize(count);
}

/// Calls `visit(slot)` for each of `count` slots that has a new object, ascending. There were `before` slots.
template <typename Visit>
void visit_new_slots(std::span<const std::uint32_t> new_slots, std::size_t before, std::size_t count,
                     const Visit& visit) {
  auto next = static_cast<std::uint32_t>(new_slots.empty() ? before : 0);
  for (const std::uint32_t slot : new_slots) {
    if (slot == no_slot) continue;
    for (; next < slot; ++next) visit(next);
    ++next;
  }
  for (; next < count; ++next) visit(next);
}

}  // namespace graze
