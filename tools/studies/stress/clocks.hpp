#pragma once

#include <chrono>
#include <ctime>

namespace graze::tools {

/// Processor time of the calling thread (CLOCK_THREAD_CPUTIME_ID) or of the process, in nanoseconds.
inline double cpu_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

inline double ns_between(std::chrono::steady_clock::time_point from,
                         std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double, std::nano>(to - from).count();
}

}  // namespace graze::tools
