#pragma once

#include <cstddef>

#include "stress/result.hpp"

namespace graze::tools {

/// Plays scenes that look like others and once cost far more, beside these others: long faces across the
/// axes, and small bodies nearly in one place. Prints the median processor time of a step on one thread, what
/// it is of the neighbour's, and of a plain loop over all vertices and faces and all pairs of edges.
StressResult run_costly_study(std::size_t frames);

}  // namespace graze::tools
