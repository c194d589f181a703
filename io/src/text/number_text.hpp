#pragma once

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "text/file_bytes.hpp"

namespace graze::io {

/// The next word of `rest`, which is cut off it. It is empty at the end. Words are parted by blanks.
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

/// NaN or infinity from a word without a sign, as the printf of any platform writes them: `nan`, `nan(ind)`,
/// `NaNQ`, `1.#IND`, `1.#QNAN0`, `inf`, `Infinity`, `1.#INF`. Nothing for another word.
inline std::optional<double> not_finite_number(std::string_view word) {
  constexpr std::size_t longest = 64;
  const std::string text = lower_case(word.substr(0, longest));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (text == "inf" || text == "infinity") return infinity;
  if (text == "nan" || text == "nanq" || text == "nans") return nan;
  if (text.starts_with("nan(") && text.ends_with(')')) return nan;
  if (!text.starts_with("1.#")) return std::nullopt;
  // Behind the letters may be what the format asked for: zeros, an exponent.
  const auto letters = std::min(text.find_first_of("0123456789+-", 3), text.size());
  if (text.find_first_not_of("0123456789e+-", letters) != std::string::npos) return std::nullopt;
  std::string kind = text.substr(3, letters - 3);
  if (kind.ends_with('e')) kind.pop_back();
  if (kind == "inf") return infinity;
  // Rounding to fewer digits turns IND, QNAN and INF into J, IO, R and the like.
  return !kind.empty() && kind.size() <= 4 ? std::optional(nan) : std::nullopt;
}

/// The whole word as a number, correctly rounded, in any locale. NaN and infinity are numbers in every
/// platform's spelling. Nothing where the word is something else or does not fit.
template <typename Number>
std::optional<Number> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) {
    if constexpr (std::numeric_limits<Number>::has_infinity) {
      const bool is_negative = word.starts_with('-');
      const auto special = not_finite_number(word.substr(is_negative ? 1 : 0));
      if (special) return static_cast<Number>(is_negative ? -*special : *special);
    }
    return std::nullopt;
  }
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
