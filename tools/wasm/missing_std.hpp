#pragma once

// What graze uses of C++20, and the standard library of Debian's Emscripten (libc++ 13) does not have yet.
// The toolchain file includes it before each source, so that the sources stay as they are for other
// platforms.

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <type_traits>

#if __cplusplus > 201703L && !defined(__cpp_lib_bit_cast)

namespace std {

template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <typename Array>
requires is_unbounded_array_v<Array> unique_ptr<Array> make_unique_for_overwrite(size_t count) {
  return unique_ptr<Array>(new remove_extent_t<Array>[count]);
}

/// The number with the fewest digits that read back as the same double. It may choose another notation than
/// to_chars() of a newer library does.
inline to_chars_result to_chars(char* first, char* last, double value) {
  constexpr int enough_digits = 17;
  array<char, 32> text{};
  for (int digits = 1; digits <= enough_digits; ++digits) {
    snprintf(text.data(), text.size(), "%.*g", digits, value);
    if (strtod(text.data(), nullptr) == value) break;
  }
  const auto length = static_cast<ptrdiff_t>(strlen(text.data()));
  if (last - first < length) return {last, errc::value_too_large};
  return {copy(text.data(), text.data() + length, first), errc()};
}

/// The number rounded to so many digits, in the notation of `%g`.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format /*general*/, int digits) {
  array<char, 32> text{};
  const auto length = static_cast<ptrdiff_t>(snprintf(text.data(), text.size(), "%.*g", digits, value));
  if (last - first < length) return {last, errc::value_too_large};
  return {copy(text.data(), text.data() + length, first), errc()};
}

}  // namespace std

#include "sums_of_three.hpp"

#endif
