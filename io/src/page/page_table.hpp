#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "text/json_text.hpp"

namespace graze::io {

/// The name of a number type in the header of a table.
template <typename Number>
constexpr std::string_view page_type() {
  if constexpr (std::same_as<Number, std::uint8_t>) return "u8";
  if constexpr (std::same_as<Number, std::uint32_t>) return "u32";
  if constexpr (std::same_as<Number, double>) return "f64";
}

/// Appends the bytes of a number, the lowest first.
template <typename Number>
void append_little_endian(std::string& bytes, Number number) {
  std::array<char, sizeof number> raw;
  std::memcpy(raw.data(), &number, sizeof number);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

/// A table of a page: arrays of numbers behind a header in JSON. docs/page_format.md describes the bytes.
class PageTable {
 public:
  PageTable() { arrays_.open('{'); }

  /// Adds an array of `count` numbers, whose bytes are given, the lowest of each first.
  void add_bytes(std::string_view name, std::string_view type, std::string_view bytes, std::size_t count);
  template <typename Number>
  void add(std::string_view name, std::span<const Number> numbers) {
    std::string bytes;
    bytes.reserve(numbers.size_bytes());
    for (const Number number : numbers) append_little_endian(bytes, number);
    add_bytes(name, page_type<Number>(), bytes, numbers.size());
  }
  /// Adds a key of the header, whose value is JSON.
  void add_key(std::string_view name, std::string_view json);

  /// The whole table.
  [[nodiscard]] std::string bytes() const;

 private:
  JsonText arrays_;
  std::string keys_;
  std::string numbers_;
};

}  // namespace graze::io
