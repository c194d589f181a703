#pragma once

#include "experiment/options.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// The motion of the paper's experiment 1, 2 or 3 (section 4), of 300, 200 or 100 frames unless the options
/// say otherwise: the same for the same seed and number of frames, and made once in a run of the program.
/// From one thread at a time.
RecordedMotion record_experiment(int number, const ExperimentOptions& options);

}  // namespace graze::tools
