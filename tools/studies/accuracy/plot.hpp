#pragma once

#include <filesystem>
#include <span>

#include "accuracy/results.hpp"

namespace graze::tools {

/// Draws time against error into a PNG: how wide the bounds of distances are, and how many contacts are
/// missing. Throws io::InputError where gnuplot fails or the file cannot be written.
void plot_time_against_error(const std::filesystem::path& path, std::span<const ModeTable> tables);

}  // namespace graze::tools
