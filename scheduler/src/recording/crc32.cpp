#include "recording/crc32.hpp"

#include <array>

namespace graze {
namespace {

constexpr std::uint32_t polynomial = 0xEDB88320U;
constexpr std::size_t bytes_at_once = 8;
using Tables = std::array<std::array<std::uint32_t, 256>, bytes_at_once>;

/// Table k has the remainder of a byte that k zero bytes follow, so that eight bytes are looked up at once.
constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) remainder = remainder >> 1 ^ ((remainder & 1) != 0 ? polynomial : 0);
    tables[0][byte] = remainder;
  }
  for (std::size_t k = 1; k < bytes_at_once; ++k)
    for (std::size_t byte = 0; byte < 256; ++byte)
      tables[k][byte] = tables[k - 1][byte] >> 8 ^ tables[0][tables[k - 1][byte] & 0xFF];
  return tables;
}
constexpr Tables tables = make_tables();

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << 8 * i;
  return value;
}

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before) {
  std::uint32_t state = ~before;
  std::size_t at = 0;
  for (; at + bytes_at_once <= bytes.size(); at += bytes_at_once) {
    const std::uint32_t low = word(bytes, at) ^ state;
    const std::uint32_t high = word(bytes, at + 4);
    state = 0;
    for (std::size_t i = 0; i < 4; ++i)
      state ^= tables[7 - i][low >> 8 * i & 0xFF] ^ tables[3 - i][high >> 8 * i & 0xFF];
  }
  for (; at < bytes.size(); ++at)
    state = state >> 8 ^ tables[0][(state ^ std::to_integer<std::uint32_t>(bytes[at])) & 0xFF];
  return ~state;
}

}  // namespace graze
