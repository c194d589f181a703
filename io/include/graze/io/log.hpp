#pragma once

#include <cstdint>
#include <graze/export.hpp>
#include <string_view>

namespace graze::io {

/// What is logged: messages of this level and the more severe ones.
enum class LogLevel : std::uint8_t { debug, info, warning, error, off };

/// Messages go to standard error, one line each, with their level. At first warnings and errors are shown.
/// Any thread.
GRAZE_API void set_log_level(LogLevel level);
GRAZE_API void log(LogLevel level, std::string_view message);

inline void log_debug(std::string_view message) {
  log(LogLevel::debug, message);
}
inline void log_info(std::string_view message) {
  log(LogLevel::info, message);
}
inline void log_warning(std::string_view message) {
  log(LogLevel::warning, message);
}
inline void log_error(std::string_view message) {
  log(LogLevel::error, message);
}

}  // namespace graze::io
