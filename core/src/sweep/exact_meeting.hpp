#pragma once

#include <optional>

#include "sweep/feature_signs.hpp"
#include "sweep/moving_features.hpp"

namespace graze {

/// Finds the first time at which two features meet, as the functions of moving_features.hpp do, by exact
/// arithmetic alone. The bounds are at most 2^-51 apart.
std::optional<SweptMeeting> exact_meeting(SweptPair pair, const FeatureSweep& sweep,
                                          std::uint64_t exact_budget);

}  // namespace graze
