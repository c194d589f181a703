#pragma once

#include <vector>

#include "experiment/paper/paper_results.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// Counts, by kind and level from 1, the vertices further from the middle vertex of their region than epsilon
/// was in the first frame. The paper argues that they stay within it, so that it need not be updated (section
/// 3.1).
std::vector<EscapeCount> count_escapes(const RecordedMotion& motion);

}  // namespace graze::tools
