#pragma once

#include <cstdint>
#include <vector>

#include "experiment/options.hpp"
#include "experiment/paper/paper_results.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// Which readings of the rows' numbers are measured.
enum class Extent : std::uint8_t { one_reading, all_readings };

/// Plays a motion to every row, to exact mode and to within, and compares each step with the independent walk
/// over all pairs of leaves.
PaperResults measure_paper(const RecordedMotion& motion, const std::vector<PaperRow>& rows,
                           const ExperimentOptions& options, Extent extent);

}  // namespace graze::tools
