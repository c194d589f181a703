#pragma once

#include "stress/result.hpp"

namespace graze::tools {

/// Reads reports at 1 kHz for `seconds` beside a loop that steps without a pause on all of the machine's
/// threads, and beside a control reader that only loads a counter. Prints the distributions of the times that
/// a read takes, in wall and in processor time.
StressResult run_reader_study(double seconds);

}  // namespace graze::tools
