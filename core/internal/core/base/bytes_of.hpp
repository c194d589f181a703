#pragma once

#include <cstddef>
#include <vector>

namespace graze {

/// Bytes of the allocator's that a vector holds. What its elements hold themselves does not count.
template <typename Element>
std::size_t bytes_of(const std::vector<Element>& elements) {
  return elements.capacity() * sizeof(Element);  // NOLINT(bugprone-sizeof-expression): of pointers too
}

}  // namespace graze
