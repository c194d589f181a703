#pragma once

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/bytes_of.hpp"

namespace graze {

struct PairRoom;

// Memory that queries use again and again. A type of it names its parts once,
//
//     template <typename Self>
//     static auto parts(Self& self) { return std::tie(self.front, self.next); }
//
// which are vectors or such memory themselves, and has what follows. What is not the same for all its parts
// it does itself, by a member of that name.

template <typename Memory>
concept HasParts = requires(Memory& memory) {
  Memory::parts(memory);
};

/// Makes as much room as `other` has. What each thread has needed all can then do without the allocator,
/// whichever of them gets the work the next time.
template <typename Element>
void reserve_as(std::vector<Element>& elements, const std::vector<Element>& other) {
  elements.reserve(other.capacity());
}
template <typename Memory>
void reserve_as(Memory& memory, const Memory& other) {
  if constexpr (requires { memory.reserve_as(other); }) {
    memory.reserve_as(other);
  } else {
    const auto to = Memory::parts(memory);
    const auto from = Memory::parts(other);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (reserve_as(std::get<I>(to), std::get<I>(from)), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(to)>>());
  }
}

/// Does that for two lists that are swapped with each other. Both get the room of the largest of all, so that
/// it does not matter how often they are swapped.
template <typename Element>
void reserve_swapped_as(std::vector<Element>& left, std::vector<Element>& right,
                        const std::vector<Element>& other_left, const std::vector<Element>& other_right) {
  const std::size_t most =
      std::max({left.capacity(), right.capacity(), other_left.capacity(), other_right.capacity()});
  left.reserve(most);
  right.reserve(most);
}

/// Makes room for pairs of a given size, before the first is met.
template <typename Memory>
void reserve(Memory& memory, const PairRoom& room) {
  if constexpr (requires { memory.reserve(room); })
    memory.reserve(room);
  else
    std::apply([&](auto&... part) { (reserve(part, room), ...); }, Memory::parts(memory));
}

/// The bytes held of the allocator's.
template <HasParts Memory>
std::size_t bytes_of(const Memory& memory) {
  if constexpr (requires { memory.bytes_of(); })
    return memory.bytes_of();
  else
    return std::apply([](const auto&... part) { return (std::size_t{0} + ... + bytes_of(part)); },
                      Memory::parts(memory));
}

}  // namespace graze
