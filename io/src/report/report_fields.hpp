#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <graze/scene_enumerators.hpp>
#include <graze/settings_fields.hpp>
#include <string_view>

#include "text/json_text.hpp"

namespace graze::io {

/// Calls `visit` with the field of each setting that a report has. Threads and arena are left out: they
/// change no answer. A report has no region distances, and so no limit of them.
template <typename Visit>
void for_each_reported_setting(const Visit& visit) {
  for_each_field<SceneSettings, &SceneSettings::threads, &SceneSettings::arena,
                 &SceneSettings::region_distances>(visit);
}
/// The key of a setting in a report.
template <auto member>
constexpr std::string_view key_of(const SettingsField<member>& field) {
  return times_among<member, &SceneSettings::time_budget>() == 1 ? "time_budget_us" : field.name;
}

/// Writes the settings that shape an answer. Those that are off are left out.
void write_settings(JsonText& json, const SceneSettings& settings);

/// Whether anything of a way out is not 0, so that files have it.
[[nodiscard]] bool is_written(const WayOut& way);

/// Writes all statistics of a step. Without times it leaves out StepBytes::threads.
void write_statistics(JsonText& json, const StepStatistics& statistics, bool include_times);

/// The file's number of the frame of `since`, in a file that numbers the frame of `report` as `frame`. Steps
/// and frames advance together. A contact from before the file's frame 0 gets 0.
std::uint64_t since_in_file(std::uint64_t since, std::uint64_t frame, const FrameReport& report);

}  // namespace graze::io
