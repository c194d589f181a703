#pragma once

#include <cstdint>
#include <graze/export.hpp>

namespace graze {

/// How often each stage decided whether two features meet between two steps. Every member is a 64-bit
/// counter. One object serves one worker, so counting needs no atomics.
struct GRAZE_API SweepCounters {
  std::uint64_t discarded = 0;  ///< pairs of features that a cheap test in double kept apart
  std::uint64_t in_double = 0;  ///< pairs that double with error bounds decided
  std::uint64_t exact = 0;      ///< pairs that went on to exact arithmetic
  std::uint64_t undecided = 0;  ///< pairs for which the budget of exact work ran out

  /// Adds every counter of `other`.
  void add(const SweepCounters& other);
};

}  // namespace graze
