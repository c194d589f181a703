#pragma once

#include "experiment/options.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// Every accuracy mode along its dial, on the paper's experiments and on real meshes: time a step against
/// recall and precision of contacts and against error of distance, with the Pareto fronts.
Study speed_against_error_study(const ExperimentOptions& options);

}  // namespace graze::tools
