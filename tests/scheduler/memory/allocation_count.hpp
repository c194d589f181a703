#pragma once

#include <cstdint>
#include <string>

namespace graze::tests {

/// Counts, in the program it is linked into, every allocation of any thread: by operator new and by malloc
/// and its kin, which it replaces.
class AllocationCount {
 public:
  /// Whether the hooks are there: on glibc, where no sanitizer has put in its own.
  static bool is_possible();

  /// Counts from here until `end`, from zero. One at a time.
  static void begin();
  /// Counts only what the thread that calls this allocates, until `end`.
  static void begin_of_this_thread();
  static void end();

  /// The number of allocations counted: by oneTBB's library, for exceptions that were thrown, and by all
  /// others.
  static std::uint64_t by_tbb();
  static std::uint64_t by_exceptions();
  static std::uint64_t by_others();
  /// Bytes that the allocator has given out now, to all the program. It need not be counting.
  static std::uint64_t held_bytes();
  /// The calls that led to the first of the others. Empty where there was none.
  static std::string first_of_others();
};

}  // namespace graze::tests
