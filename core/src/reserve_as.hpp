#pragma once

#include <graze/bytes_of.hpp>
#include <vector>

namespace graze {

// What working memory has besides:
// - `reserve_as(other)`: makes as much room as `other` has. What each thread has needed all can then do
//   without the allocator, whichever of them gets the work the next time.
// - `reserve(room)`: makes room for pairs of a given size, before the first is met.
// - `byte_count()`: the bytes held of the allocator's.

template <typename Element>
void reserve_as(std::vector<Element>& elements, const std::vector<Element>& other) {
  elements.reserve(other.capacity());
}

}  // namespace graze
