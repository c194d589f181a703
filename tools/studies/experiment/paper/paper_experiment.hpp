#pragma once

#include "experiment/options.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// The paper's experiment 1, 2 or 3: its rows, exact mode and within on one recorded motion, each step
/// compared with all pairs of leaf regions. Writes the motion as scene files and vertex caches into a folder
/// experiment_N of the output folder. Throws std::runtime_error for a file that cannot be written.
Study paper_experiment(int number, const ExperimentOptions& options);

}  // namespace graze::tools
