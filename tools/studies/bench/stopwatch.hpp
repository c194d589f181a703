#pragma once

#include <algorithm>
#include <chrono>

#include "stress/clocks.hpp"

namespace graze::bench {

/// Time since it was made. With one thread that is the lesser of wall clock and the thread's processor time,
/// so that what other processes take does not count. The wall clock is the finer one for short times.
class Stopwatch {
 public:
  explicit Stopwatch(unsigned threads)
      : threads_(threads),
        cpu_ns_(tools::cpu_ns(CLOCK_THREAD_CPUTIME_ID)),
        start_(std::chrono::steady_clock::now()) {}

  [[nodiscard]] double ms() const {
    const double wall = tools::ns_between(start_, std::chrono::steady_clock::now());
    if (threads_ > 1) return wall / 1e6;
    return std::min(wall, tools::cpu_ns(CLOCK_THREAD_CPUTIME_ID) - cpu_ns_) / 1e6;
  }

 private:
  unsigned threads_;
  double cpu_ns_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace graze::bench
