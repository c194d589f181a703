#pragma once

#include <cstddef>
#include <vector>

#include "experiment/paper/paper_results.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// Compares the contacts of `features` in exact mode and in within with exact arithmetic, in one in `every`
/// of the pairs of objects that have any, counted through all frames, and in as many that have none.
std::vector<ContactCheck> check_features(const RecordedMotion& motion, double contact_distance,
                                         std::size_t every);

}  // namespace graze::tools
