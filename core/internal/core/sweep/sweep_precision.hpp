#pragma once

#include <cstdint>

namespace graze {

/// How precisely the time is found at which two moving features meet.
struct SweepPrecision {
  /// The upper bound of the time is at most this much above the lower one. It is at least 2^-52.
  double tolerance = 1e-6;
  /// The most subdivisions of time in exact arithmetic for one pair of features. Each one halves an
  /// interval that holds several times at which the four points lie in a plane.
  std::uint64_t exact_budget = 1024;
};

}  // namespace graze
