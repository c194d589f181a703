#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <graze/settings.hpp>

#include "text/json_text.hpp"

namespace graze::io {

/// Writes the settings that shape an answer. Threads are left out: they do not change it.
void write_settings(JsonText& json, const SceneSettings& settings);

/// Writes all statistics of a step; without times also no StepStatistics::thread_bytes.
void write_statistics(JsonText& json, const StepStatistics& statistics, bool include_times);

/// The file's number of the frame of `since`, in a file that numbers the frame of `report` as `frame`. Steps
/// and frames advance together. A contact from before the file's frame 0 gets 0.
std::uint64_t since_in_file(std::uint64_t since, std::uint64_t frame, const FrameReport& report);

}  // namespace graze::io
