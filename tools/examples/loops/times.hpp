#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

/// What the two loops share: times, options and shapes.
namespace loops {

using Clock = std::chrono::steady_clock;

/// Returns the milliseconds between two moments.
double milliseconds(Clock::time_point from, Clock::time_point to);

/// Returns for how many milliseconds processors have worked on the calling thread so far.
double processor_milliseconds();

/// Collects the times of one part of a loop, in milliseconds.
class Times {
 public:
  /// Makes room for `count` times, so that add() takes no memory until then.
  explicit Times(std::size_t count) { values_.reserve(count); }
  void add(double milliseconds) { values_.push_back(milliseconds); }
  /// Adds the time since `start`, and moves `start` to now.
  void lap(Clock::time_point& start);
  /// Returns the time that a share of all times does not exceed: 0.5 gives the median, 1 the worst.
  [[nodiscard]] double percentile(double share) const;
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> values_;
};

}  // namespace loops
