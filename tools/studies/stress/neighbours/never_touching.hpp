#pragma once

#include <cstddef>

#include "stress/result.hpp"

namespace graze::tools {

/// Steps scenes of boxes that lie in each other but can never touch, by each filter, while a ball moves far
/// from them. Prints the first step and the median of the others beside those of the ball alone.
StressResult run_never_touching_study(std::size_t frames);

}  // namespace graze::tools
