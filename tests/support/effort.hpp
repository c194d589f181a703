#pragma once

#include <algorithm>
#include <cstdint>

namespace graze::tests {

/// How often a test repeats something that it repeats `full` times at full effort. GRAZE_TEST_EFFORT says how
/// much of that a build does, in percent. It is at least once.
constexpr std::uint64_t repeats(std::uint64_t full) {
  return std::max<std::uint64_t>(1, full * GRAZE_TEST_EFFORT / 100);
}

/// Whether tests do all of what they repeat. Where they do not, some leave out what is there in another form.
constexpr bool at_full_effort = GRAZE_TEST_EFFORT >= 100;

}  // namespace graze::tests
