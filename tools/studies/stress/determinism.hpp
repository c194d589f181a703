#pragma once

#include <cstddef>

#include "stress/result.hpp"

namespace graze::tools {

struct DeterminismOptions {
  std::size_t frames = 20;
  std::size_t repeats = 3;
  bool large = false;  ///< the large pair has 100,000 vertices each
};

/// Plays every scene with 1, 2, 3, 4, 8 and 16 threads, again and again, and compares the hashes of all
/// reports.
StressResult run_determinism_study(const DeterminismOptions& options);

}  // namespace graze::tools
