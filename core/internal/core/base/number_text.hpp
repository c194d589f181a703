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

/// A number for a message, rounded to so many digits, which are 1 to 17.
inline std::string number_text(double value, int digits) {
  std::array<char, 32> text;
  return {
      text.data(),
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}

}  // namespace graze
