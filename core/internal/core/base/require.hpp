#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace graze {

/// Used by the structure validators, which GRAZE_VALIDATE switches on. Throws std::logic_error with the
/// invariant that does not hold and the element.
inline void require(bool holds, const char* what, std::size_t index) {
  if (!holds)
    throw std::logic_error(std::string("graze validator: ") + what + " at " + std::to_string(index));
}

}  // namespace graze
