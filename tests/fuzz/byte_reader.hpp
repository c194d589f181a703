#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace graze::fuzz {

/// Takes values out of a fuzzer's bytes, front to back. Gives zeros when they are used up.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] std::span<const std::uint8_t> rest() const { return rest_; }

  std::uint8_t byte() { return raw<std::uint8_t>(); }
  bool flag() { return (byte() & 1U) != 0; }
  /// 0 to count - 1. The count is from 1 to 65536.
  std::uint32_t below(std::uint32_t count) {
    return (count <= 256 ? std::uint32_t{byte()} : std::uint32_t{raw<std::uint16_t>()}) % count;
  }
  /// True once in `count` values of a byte, false when the bytes are used up.
  bool once_in(std::uint32_t count) { return below(count) == count - 1; }

  /// A number of any bit pattern.
  template <typename Number>
  Number raw() {
    Number number{};
    const std::size_t size = std::min(sizeof number, rest_.size());
    std::memcpy(&number, rest_.data(), size);
    rest_ = rest_.subspan(size);
    return number;
  }

  /// Up to `length` bytes.
  std::string text(std::size_t length) {
    const auto part = rest_.first(std::min(length, rest_.size()));
    rest_ = rest_.subspan(part.size());
    return {part.begin(), part.end()};
  }

 private:
  std::span<const std::uint8_t> rest_;
};

}  // namespace graze::fuzz
