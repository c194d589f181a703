#pragma once

#include <string>

#include "experiment/paper/paper_results.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// The text about one experiment, given by its number. It says what was done, at which scale and why, how to
/// read the numbers, and what the results are.
std::string text_of(int experiment, const RecordedMotion& motion, const PaperResults& results);

}  // namespace graze::tools
