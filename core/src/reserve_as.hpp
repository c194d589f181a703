#pragma once

#include <vector>

namespace graze {

/// Makes as much room as `other` has. Working memory has the same function: what each thread has needed all
/// can then do without the allocator, whichever of them gets the work the next time.
template <typename Element>
void reserve_as(std::vector<Element>& elements, const std::vector<Element>& other) {
  elements.reserve(other.capacity());
}

}  // namespace graze
