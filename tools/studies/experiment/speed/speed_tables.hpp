#pragma once

#include <span>
#include <vector>

#include "experiment/speed/speed_measures.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// The scenes, and what each setting answered. If it is timed, also how long it took, the means over the
/// scenes, and the fronts.
std::vector<ResultTable> speed_tables(std::span<const SpeedResults> scenes);

}  // namespace graze::tools
