#include "jobs/job_work.hpp"

namespace graze {

// Fitted to heaps of balls in all details, within a factor of two. What float discards takes no time that
// shows.
double JobWork::nanoseconds_of(const PairCounters& counters) {
  const auto times = [](std::uint64_t count, double nanoseconds) {
    return static_cast<double>(count) * nanoseconds;
  };
  return times(counters.region_pairs_tested, 70) + times(counters.leaf_pairs_tested, 1500) +
         times(counters.named_in_float, 80) + times(counters.decided_in_double, 150) +
         times(counters.exact_decisions, 800);
}

}  // namespace graze
