#pragma once

#include <span>
#include <string>
#include <vector>

#include "accuracy/settings.hpp"
#include "experiment/speed/speed_measures.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// A setting over all scenes that have it.
struct SpeedMean {
  std::string setting;
  ModeFamily family = ModeFamily::exact;
  SpeedQuestion question = SpeedQuestion::contacts;
  double relative_ms = 1;                                                   ///< geometric mean
  double recall = 0, precision = 0, contact_error = 0, distance_error = 0;  ///< means
};

/// Settings that all scenes have, in the order of the first scene.
std::vector<SpeedMean> means_of(std::span<const SpeedResults> scenes);

/// Time against error with the Pareto front: means over the scenes first, then each scene's.
std::vector<Figure> speed_figures(std::span<const SpeedResults> scenes);

}  // namespace graze::tools
