#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/scenes/scenes.hpp"
#include "figures/result_table.hpp"

namespace graze::bench {

/// Measures the details `features` and `nearest` side by side on one thread, both with and without solids. A
/// scene with an open surface has no rows with solids. `frames` are timed, or the scene's own number if it is
/// 0. A small triangle over a flat grid comes last.
tools::ResultTable compare_surface_details(const std::vector<BenchScene>& scenes, std::size_t frames);

}  // namespace graze::bench
