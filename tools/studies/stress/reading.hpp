#pragma once

#include <cstddef>

#include "stress/result.hpp"

namespace graze::tools {

struct ReadingOptions {
  std::size_t objects = 0;
  std::size_t frames = 9;
};

/// Compares how a step takes up positions with a plain loop over the same memory, on the same number of
/// threads. The loop reads what the step reads, and copies as many objects as the step copies. Checks that
/// all numbers of threads report the same bits.
StressResult run_reading_study(const ReadingOptions& options);

}  // namespace graze::tools
