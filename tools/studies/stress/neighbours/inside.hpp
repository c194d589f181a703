#pragma once

#include <cstddef>

#include "stress/result.hpp"

namespace graze::tools {

/// Plays a body wholly inside a solid, in each detail that looks for what is inside, on one thread. Beside
/// each median time of a step it prints that of a plain tree that finds the distance of each vertex of the
/// body. Checks that the distances of `nearest` are the tree's.
StressResult run_inside_study(std::size_t frames);

}  // namespace graze::tools
