#pragma once

#include <vector>

#include "experiment/options.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// Real meshes of the data folder in their connected parts, each with a smooth wobble of half an edge. They
/// are a cloth in a funnel, an armadillo between rollers, and a body with its intestines. Each has 4 frames
/// unless the options say otherwise. One that is missing is left out, with a line on standard error.
std::vector<RecordedMotion> record_real_motions(const ExperimentOptions& options);

}  // namespace graze::tools
