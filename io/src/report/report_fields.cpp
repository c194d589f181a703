#include "report/report_fields.hpp"

#include <algorithm>
#include <chrono>
#include <concepts>
#include <graze/enumerators.hpp>
#include <optional>

#include "report/statistics_fields.hpp"

namespace graze::io {
namespace {

void write_value(JsonText& json, std::floating_point auto value) {
  json.real(value);
}
void write_value(JsonText& json, std::unsigned_integral auto value) {
  json.whole(value);
}
void write_value(JsonText& json, std::same_as<bool> auto value) {
  json.flag(value);
}
void write_value(JsonText& json, NamedEnumeration auto value) {
  json.text(name_of(value));
}
void write_value(JsonText& json, std::chrono::microseconds time) {
  json.whole(static_cast<std::uint64_t>(time.count()));
}
void write_value(JsonText& json, const Accuracy& accuracy) {
  if (accuracy.mode() == AccuracyMode::exact) {
    json.text("exact");
    return;
  }
  json.open('{');
  if (accuracy.mode() == AccuracyMode::within) {
    json.key("within").real(accuracy.tolerance());
  } else {
    json.key("paper").open('[');
    for (const double epsilon : accuracy.epsilon()) json.real(epsilon);
    json.close(']');
  }
  json.close('}');
}

template <typename Value>
void write_setting(JsonText& json, std::string_view key, const Value& value) {
  json.key(key);
  write_value(json, value);
}
template <typename Value>
void write_setting(JsonText& json, std::string_view key, const std::optional<Value>& value) {
  if (value) write_value(json.key(key), *value);
}
void write_setting(JsonText& json, std::string_view key, bool is_on) {
  if (is_on) json.key(key).flag(true);
}
/// A number that is 0 where it is off.
void write_setting(JsonText& json, std::string_view key, std::size_t most) {
  if (most > 0) json.key(key).whole(most);
}

}  // namespace

void write_settings(JsonText& json, const SceneSettings& settings) {
  json.open('{');
  for_each_reported_setting(
      [&](const auto& field) { write_setting(json, key_of(field), settings.*field.member); });
  json.close('}');
}

bool is_written(const WayOut& way) {
  return way.fullness != 0 || !way.point.isZero(0);
}

void write_statistics(JsonText& json, const StepStatistics& statistics, bool include_times) {
  json.open('{');
  for (const auto& [name, member] : count_fields) json.key(name).whole(statistics.*member);
  for (const auto& [name, member] : work_fields) json.key(name).whole(statistics.work.*member);
  for (const auto& [name, member] : bytes_fields) json.key(name).whole(statistics.bytes.*member);
  const auto& expanded = statistics.work.regions_expanded;
  const auto last =
      std::find_if(expanded.rbegin(), expanded.rend(), [](std::uint64_t count) { return count != 0; });
  json.key("regions_expanded").open('[');
  std::for_each(expanded.begin(), last.base(), [&](std::uint64_t count) { json.whole(count); });
  json.close(']');
  if (include_times) {
    json.key(thread_bytes_field.name).whole(statistics.bytes.*thread_bytes_field.member);
    for (const auto& [name, member] : time_fields) json.key(name).real(statistics.times.*member);
  }
  json.close('}');
}

std::uint64_t since_in_file(std::uint64_t since, std::uint64_t frame, const FrameReport& report) {
  if (frame >= report.frame()) return since + (frame - report.frame());
  const std::uint64_t ahead = report.frame() - frame;
  return since > ahead ? since - ahead : 0;
}

}  // namespace graze::io
