#pragma once

#include "experiment/options.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// Kinds of bounds over graze's own octree, compared: the comparison that the paper names as future work.
/// Every one must find all vertices that a search without bounds finds near each other; throws CheckFailed
/// otherwise.
Study region_bounds_study(const ExperimentOptions& options);

}  // namespace graze::tools
