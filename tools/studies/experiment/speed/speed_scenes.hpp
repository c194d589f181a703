#pragma once

#include <string>
#include <vector>

#include "experiment/options.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// A motion that speed and error are measured on.
struct SpeedScene {
  std::string name;  ///< as in a file's name
  std::string title;
  RecordedMotion motion;
  double contact_distance = 0;
};

/// The ends of the paper's three experiments, 25 frames each, where most is in contact: the contact distance
/// is the last number of the row that the paper calls best. And the real motions, whose is the mean edge
/// length.
std::vector<SpeedScene> speed_scenes(const ExperimentOptions& options);

}  // namespace graze::tools
