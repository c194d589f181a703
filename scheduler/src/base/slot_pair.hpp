#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

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

}  // namespace graze
