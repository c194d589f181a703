#pragma once

#include <cstddef>

#include "stress/result.hpp"

namespace graze::tools {

/// Plays scenes of surfaces that coincide exactly beside their neighbours in which they do not, in every
/// detail but `regions`, on one thread, and prints the median time of a step of each.
StressResult run_coinciding_study(std::size_t frames);

}  // namespace graze::tools
