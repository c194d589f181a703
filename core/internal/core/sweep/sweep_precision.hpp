#pragma once

#include <cstdint>

namespace graze {

/// How precisely the time is found at which two moving features meet.
struct SweepPrecision {
  /// The upper bound of the time is at most this much above the lower one. Exact arithmetic gives bounds that
  /// are 2^-50 apart at most, so a smaller tolerance has no effect there.
  double tolerance = 1e-6;
  /// The most subdivisions of time between doubles for one pair of features, up to 1024. Each one takes a
  /// step towards telling two times apart at which the four points lie in a plane.
  std::uint64_t exact_budget = 1024;
};

}  // namespace graze
