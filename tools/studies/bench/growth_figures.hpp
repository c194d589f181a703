#pragma once

#include <filesystem>
#include <vector>

#include "bench/run.hpp"

namespace graze::bench {

/// Draws a frame's median against the number of objects, from the scenes G…, and of vertices, from V…. Each
/// task gets a PNG in a folder that is there, `growth_objects_A.png` and so on. It shows runs of the first
/// number of threads. Nothing is drawn where fewer than two such scenes were run. Throws io::InputError where
/// gnuplot fails.
void draw_growth(const std::filesystem::path& folder, const std::vector<Run>& runs);

}  // namespace graze::bench
