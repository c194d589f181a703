#pragma once

#include <cstdint>

namespace graze::tests {

/// Counts what operator new is asked for, by any thread of the program that this is linked into, and lets
/// some of it fail.
class FailingAllocator {
 public:
  enum class Lack {
    once,         ///< one allocation fails
    from_then_on  ///< that one and all after it
  };
  /// Until `end` the allocation at `place` fails, where the next one is at 0. One at a time.
  static void begin(std::uint64_t place, Lack lack);
  /// Allocations since `begin`. None fails any more.
  static std::uint64_t end();
  /// From now on, allocations of this thread are not counted and do not fail.
  static void exempt_this_thread();
  /// A place that is never reached.
  static constexpr std::uint64_t never = ~std::uint64_t{0};
};

}  // namespace graze::tests
