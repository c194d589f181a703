#pragma once

#include <cstddef>

#include "stress/result.hpp"

namespace graze::tools {

struct TogetherOptions {
  std::size_t frames = 400;  ///< of the small scene, in each way, alone and beside the large one
};

/// Steps a small scene every few milliseconds while a large one steps without a pause, in all ways in which
/// two scenes may share threads. Shows how long the small steps take, beside those with nothing else to do
/// and beside plain arithmetic on as many threads. Checks that the small scene reports the same bits in all.
StressResult run_together_study(const TogetherOptions& options);

}  // namespace graze::tools
