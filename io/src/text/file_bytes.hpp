#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace graze::io {

inline std::string_view as_text(std::string_view text) {
  return text;
}
template <std::integral Number>
std::string as_text(Number number) {
  return std::to_string(number);
}

/// The parts, texts and whole numbers, one after the other.
template <typename... Parts>
std::string joined(const Parts&... parts) {
  std::string text;
  (text.append(as_text(parts)), ...);
  return text;
}

/// A message of one line: "<file>: <what>".
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what);
/// "<file>: line <line>: <what>".
[[noreturn]] void fail(const std::filesystem::path& path, std::size_t line, const std::string& what);

/// Throws InputError unless `path` is a file that is not empty.
void require_file(const std::filesystem::path& path);

/// Enough for any header.
inline constexpr std::size_t header_bytes = 65536;

/// The whole file, or its first `limit` bytes. Throws InputError when it is missing, empty or unreadable.
std::string read_bytes(const std::filesystem::path& path,
                       std::size_t limit = std::numeric_limits<std::size_t>::max());

/// The text with small letters for the capitals of ASCII.
std::string lower_case(std::string_view text);

/// The 32-bit word that begins at `offset`. There are four bytes.
std::uint32_t word_at(std::string_view bytes, std::size_t offset, bool is_big_endian = false);

/// The path's extension in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace graze::io
