#pragma once

#include <string>

#include "accuracy/results.hpp"

namespace graze::tools {

/// Markdown tables, each ending with an empty line.
std::string kernel_distance_table(const KernelStudy& study);
std::string kernel_point_table(const KernelStudy& study);
std::string decision_table(const AccuracyResults& results);
std::string mode_table(const std::vector<ModeResult>& results, std::uint32_t frames);
/// How long a step takes, and how that compares with exact mode.
std::string time_table(const ModeTable& modes);

}  // namespace graze::tools
