#pragma once

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

namespace graze::io {

/// The next word of `rest`, which is cut off it; empty at the end. Words are parted by blanks.
inline std::string_view next_word(std::string_view& rest) {
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const auto begin = rest.find_first_not_of(blanks);
  if (begin == std::string_view::npos) {
    rest = {};
    return {};
  }
  const auto end = std::min(rest.find_first_of(blanks, begin), rest.size());
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

/// The whole word as a number, correctly rounded, in any locale; `nan` and `inf` are numbers here. Nothing
/// where the word is something else or does not fit.
template <typename Number>
std::optional<Number> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc()) return value;
  if constexpr (std::numeric_limits<Number>::has_infinity) {
    if (error == std::errc::result_out_of_range) {
      const bool tiny =
          word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
      const Number magnitude = tiny ? Number{0} : std::numeric_limits<Number>::infinity();
      return word.starts_with('-') ? -magnitude : magnitude;
    }
  }
  return std::nullopt;
}

}  // namespace graze::io
