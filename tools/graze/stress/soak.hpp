#pragma once

#include <cstdint>

#include "stress/result.hpp"

namespace graze::tools {

struct SoakOptions {
  double minutes = 30;
  std::uint64_t frames = 0;  ///< above 0: as many instead, however long they take
  std::uint64_t seed = 1;
};

/// Treats a scene badly: bodies come and go, jump, hold NaN; calls are wrong; pairs and rules
/// change; two threads stage while a third steps and two more hold old reports; the scene is made anew with
/// other settings. Checks that every 100th frame equals a scene built afresh, that held reports do not
/// change, and that memory does not grow after a warm-up.
StressResult run_soak_study(const SoakOptions& options);

}  // namespace graze::tools
