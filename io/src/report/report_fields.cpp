#include "report/report_fields.hpp"

#include <algorithm>
#include <graze/io/scene_file.hpp>

#include "report/statistics_fields.hpp"

namespace graze::io {
namespace {

void write_accuracy(JsonText& json, const Accuracy& accuracy) {
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

}  // namespace

void write_settings(JsonText& json, const SceneSettings& settings) {
  json.open('{');
  json.key("contact_distance").real(settings.contact_distance);
  json.key("range").real(settings.range);
  json.key("detail").text(to_string(settings.detail));
  json.key("accuracy");
  write_accuracy(json, settings.accuracy);
  if (settings.time_budget)
    json.key("time_budget_us").whole(static_cast<std::uint64_t>(settings.time_budget->count()));
  if (settings.work_budget) json.key("work_budget").whole(*settings.work_budget);
  if (settings.max_contacts) json.key("max_contacts").whole(*settings.max_contacts);
  if (settings.max_contacts_per_pair)
    json.key("max_contacts_per_pair").whole(*settings.max_contacts_per_pair);
  json.close('}');
}

void write_statistics(JsonText& json, const StepStatistics& statistics, bool include_times) {
  json.open('{');
  for (const auto& [name, member] : counter_fields) json.key(name).whole(statistics.*member);
  const auto& expanded = statistics.regions_expanded;
  const auto last =
      std::find_if(expanded.rbegin(), expanded.rend(), [](std::uint64_t count) { return count != 0; });
  json.key("regions_expanded").open('[');
  std::for_each(expanded.begin(), last.base(), [&](std::uint64_t count) { json.whole(count); });
  json.close(']');
  if (include_times) {
    json.key(thread_field.first).whole(statistics.*thread_field.second);
    for (const auto& [name, member] : time_fields) json.key(name).real(statistics.*member);
  }
  json.close('}');
}

std::uint64_t since_in_file(std::uint64_t since, std::uint64_t frame, const FrameReport& report) {
  if (frame >= report.frame()) return since + (frame - report.frame());
  const std::uint64_t ahead = report.frame() - frame;
  return since > ahead ? since - ahead : 0;
}

}  // namespace graze::io
