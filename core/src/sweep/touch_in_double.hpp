#pragma once

#include <cstdint>

#include "arithmetic/arithmetic.hpp"
#include "sweep/feature_signs.hpp"
#include "sweep/moving_features.hpp"

namespace graze {

/// The answer of double arithmetic, which is certain of every time in an interval.
enum class CertainTouch : std::uint8_t {
  unsure,
  no,          ///< at no time do the features touch
  if_coplanar  ///< they touch at each time at which the four points lie in a plane
};

/// Asks whether two features touch. The interval of time is a ball.
CertainTouch touch_in_double(SweptPair pair, const FeatureSweep& sweep, const Ball& time);

}  // namespace graze
