#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/pair/pair_counters.hpp"

namespace graze {

/// Estimates how long the jobs of a step take, from what the jobs of the last steps tested. It goes by counts
/// alone, so that it is the same on any machine and with any number of threads.
class JobWork {
 public:
  /// Notes the counters of a step in which so many jobs tested their pairs. A step of cheap jobs lowers the
  /// estimate by an eighth at most: what rests now may move in the next step.
  void note(const PairCounters& counters, std::size_t jobs) {
    if (jobs == 0) return;
    const double each = nanoseconds_of(counters) / static_cast<double>(jobs);
    each_ = is_known_ ? std::max(each, 0.875 * each_) : each;
    is_known_ = true;
    long_ = std::max(least_long, nanoseconds_of(counters) / parts);
  }
  /// The time of so many jobs on one thread, in nanoseconds. It is infinite before the first step with jobs.
  [[nodiscard]] double nanoseconds_of(std::size_t jobs) const { return static_cast<double>(jobs) * each_; }
  /// The time of what was counted.
  static double nanoseconds_of(const PairCounters& counters);
  /// Whether a pair whose last test took so long should begin before others, since a step on many processors
  /// may wait for it.
  [[nodiscard]] bool is_long(double nanoseconds) const { return nanoseconds > long_; }

 private:
  static constexpr double least_long = 30'000;
  static constexpr double parts = 128;  ///< of all jobs

  bool is_known_ = false;
  double each_ = std::numeric_limits<double>::infinity();
  double long_ = least_long;
};

}  // namespace graze
