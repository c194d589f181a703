#pragma once

#include <cstdint>
#include <functional>
#include <graze/graze.hpp>

#include "stress/result.hpp"

namespace graze::tools {

struct SoakOptions {
  double minutes = 30;
  std::uint64_t frames = 0;  ///< above 0: as many instead, however long they take
  std::uint64_t seed = 1;
  /// Takes a step in place of Scene::step, and gives no report where the step has thrown for lack of memory.
  /// Not asked for steps that are compared with a scene built afresh.
  std::function<ReportHandle(Scene&)> step = nullptr;
  /// Called first on each thread that the soak starts.
  std::function<void()> begin_thread = nullptr;
};

/// Treats a scene badly. Bodies come and go, jump, hold NaN. Calls are wrong. Pairs and rules change. Two
/// threads stage while a third steps and two more hold old reports. The scene is made anew with other
/// settings. Checks that every 100th frame equals a scene built afresh, that held reports do not change, and
/// that memory does not grow after a warm-up.
StressResult run_soak_study(const SoakOptions& options);

}  // namespace graze::tools
