#pragma once

#include <cstdarg>
#include <cstdint>
#include <string>
#include <vector>

namespace graze::tools {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);
/// As format(), with arguments that another function was given.
[[gnu::format(printf, 1, 0)]] std::string format_list(const char* pattern, va_list arguments);

/// A count as printf's %llu takes it.
inline unsigned long long number(std::uint64_t value) {
  return value;
}

/// A number with so many decimals.
std::string fixed(double value, int decimals);

/// A number with so many digits; a dash for one that is not finite.
std::string rounded(double value, int digits);

/// "1 frame", "2 frames".
std::string counted(std::uint64_t count, const std::string& noun);

/// All 16 digits of a hash.
std::string hash_text(std::uint64_t hash);

/// Texts with a separator between them.
std::string joined(const std::vector<std::string>& texts, const char* separator = ", ");

/// Prints at once, also where standard output is a file or a pipe.
void print(const std::string& text);

}  // namespace graze::tools
