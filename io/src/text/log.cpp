#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <graze/io/log.hpp>
#include <graze/io/printable.hpp>
#include <memory>

namespace graze::io {
namespace {

spdlog::level::level_enum spdlog_level(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
    case LogLevel::off:
      break;
  }
  return spdlog::level::off;
}

/// Not registered with spdlog, so that a program's own loggers and patterns are left alone.
spdlog::logger& logger() {
  static spdlog::logger instance = [] {
    spdlog::logger made("graze", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made.set_pattern("%n: %l: %v");
    made.set_level(spdlog::level::warn);
    made.flush_on(spdlog::level::trace);
    return made;
  }();
  return instance;
}

}  // namespace

void set_log_level(LogLevel level) {
  logger().set_level(spdlog_level(level));
}

void log(LogLevel level, std::string_view message) {
  if (level != LogLevel::off) logger().log(spdlog_level(level), "{}", printable(message));
}

}  // namespace graze::io
