#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace graze {

/// Used by the structure validators, which GRAZE_VALIDATE switches on: throws std::logic_error that names
/// what does not hold, and of which element.
inline void require(bool holds, const char* what, std::size_t index) {
  if (!holds)
    throw std::logic_error(std::string("graze validator: ") + what + " at " + std::to_string(index));
}

}  // namespace graze
