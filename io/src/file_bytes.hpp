#pragma once

#include <concepts>
#include <cstddef>
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

/// The path's extension in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace graze::io
