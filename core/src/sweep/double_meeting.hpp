#pragma once

#include <cstdint>

#include "sweep/feature_signs.hpp"
#include "sweep/moving_features.hpp"

namespace graze {

/// The answer of double arithmetic with error bounds about two features that move.
struct DoubleMeeting {
  enum class Answer : std::uint8_t {
    unsure,
    discarded,  ///< they do not meet, by a cheap test
    apart,      ///< they do not meet
    meets,
  };
  Answer answer = Answer::unsure;
  SweptMeeting meeting;  ///< where they meet
};

/// Finds out when two features meet, with bounds of the time that are at most `tolerance` apart.
DoubleMeeting meeting_in_double(SweptPair pair, const FeatureSweep& sweep, double tolerance);

}  // namespace graze
