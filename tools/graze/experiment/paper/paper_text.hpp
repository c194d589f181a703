#pragma once

#include <string>

#include "experiment/paper/paper_results.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// What was done in the experiment of a number, at which scale and why, how the numbers are read, and what
/// came of it.
std::string text_of(int experiment, const RecordedMotion& motion, const PaperResults& results);

}  // namespace graze::tools
