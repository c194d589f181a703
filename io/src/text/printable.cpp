#include <array>
#include <cstdint>
#include <cstdio>
#include <graze/io/printable.hpp>

namespace graze::io {
namespace {

/// A character of UTF-8. A byte that begins none is a character of its own, which is not valid.
struct Utf8Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool is_valid = false;
};

/// The number of bytes that a first byte announces, 0 for a byte that begins no character.
std::size_t announced_bytes(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2) return 0;
  if (first < 0xE0) return 2;
  if (first < 0xF0) return 3;
  return first < 0xF5 ? 4 : 0;
}

/// The character at the beginning of a text, which is not empty.
Utf8Character first_character(std::string_view text) {
  constexpr std::array<std::uint32_t, 5> smallest_code{0, 0, 0x80, 0x800, 0x10000};
  const auto first = static_cast<unsigned char>(text[0]);
  Utf8Character character{first, announced_bytes(first), true};
  if (character.bytes == 1) return character;
  if (character.bytes == 0 || character.bytes > text.size()) return {first, 1, false};
  character.code = first & (0x7FU >> character.bytes);
  for (std::size_t i = 1; i < character.bytes; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xC0U) != 0x80U) return {first, 1, false};
    character.code = character.code << 6U | (next & 0x3FU);
  }
  const bool is_surrogate = character.code >= 0xD800 && character.code <= 0xDFFF;
  if (character.code < smallest_code[character.bytes] || character.code > 0x10FFFF || is_surrogate)
    return {first, 1, false};
  return character;
}

bool is_in(std::uint32_t code, std::uint32_t first, std::uint32_t last) {
  return code >= first && code <= last;
}

/// Control characters, ends of lines of Unicode, and characters that turn the direction of writing.
bool is_obeyed(std::uint32_t code) {
  return code < 0x20 || is_in(code, 0x7F, 0x9F) || is_in(code, 0x2028, 0x202E) || is_in(code, 0x2066, 0x2069);
}

std::string spelled_out(std::uint32_t code) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), code < 0x100 ? "\\x%02x" : "\\u%04x", static_cast<unsigned>(code));
  return text.data();
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
    if (character.code >= '\t' && character.code <= '\r')
      shown += ' ';
    else if (!character.is_valid || is_obeyed(character.code))
      shown += spelled_out(character.code);
    else
      shown += text.substr(0, character.bytes);
    text.remove_prefix(character.bytes);
  }
  return shown;
}

}  // namespace graze::io
