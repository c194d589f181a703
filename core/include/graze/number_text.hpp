#pragma once

#include <array>
#include <charconv>
#include <string>

namespace graze {

/// A number for a message: the fewest digits that read back as the same double, so that 1e-9 does not look
/// like 0.
inline std::string number_text(double value) {
  std::array<char, 32> text;  // the longest are 24 characters
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace graze
