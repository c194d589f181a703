#pragma once

#include "bench/options.hpp"

namespace graze::tools {

/// Makes the comparison that is asked for instead of the usual one, and prints it. Returns whether one was.
bool compare_instead(const BenchOptions& options);

}  // namespace graze::tools
