#pragma once

#include <cstdint>
#include <graze/export.hpp>
#include <string_view>

namespace graze::io {

/// @addtogroup io_log
/// @{

/// How severe a message is, in ascending order. As a setting it selects the messages of that level and above.
enum class LogLevel : std::uint8_t {
  debug,    ///< Steps of the work, for those who look for a fault.
  info,     ///< Steps of the work that a user may want to see.
  warning,  ///< Something was left out or changed.
  error,    ///< Something failed.
  off,      ///< As a setting: no messages. No message has this level.
};

/// Selects the messages that are shown: those of `level` and more severe ones. At first warnings and errors
/// are shown. Any thread may call it.
GRAZE_API void set_log_level(LogLevel level);
/// Writes a message with its level to standard error, as one line, as printable() shows it. Any thread may
/// call it. LogLevel::off writes nothing.
GRAZE_API void log(LogLevel level, std::string_view message);

/// Writes a message of level LogLevel::debug. Any thread may call it.
inline void log_debug(std::string_view message) {
  log(LogLevel::debug, message);
}
/// Writes a message of level LogLevel::info. Any thread may call it.
inline void log_info(std::string_view message) {
  log(LogLevel::info, message);
}
/// Writes a message of level LogLevel::warning. Any thread may call it.
inline void log_warning(std::string_view message) {
  log(LogLevel::warning, message);
}
/// Writes a message of level LogLevel::error. Any thread may call it.
inline void log_error(std::string_view message) {
  log(LogLevel::error, message);
}

/// @}

}  // namespace graze::io
