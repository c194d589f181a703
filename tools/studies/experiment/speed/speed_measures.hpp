#pragma once

#include <string>
#include <vector>

#include "experiment/options.hpp"
#include "experiment/speed/speed_scenes.hpp"
#include "experiment/speed/speed_settings.hpp"
#include "experiment/speed/vertex_truth.hpp"

namespace graze::tools {

/// The answers of a setting, and whether it is on a front, where no setting beats it in both time and error.
struct SpeedMeasure {
  SpeedQuestion question = SpeedQuestion::contacts;
  ModeResult result;
  bool is_timed = false;           ///< its answers depend on the machine
  double relative_ms = 0;          ///< of exact mode's time for the same question
  bool on_contact_front = false;   ///< only for `contacts`
  bool on_distance_front = false;  ///< only for `distances`

  /// The share of contacts, true or reported, that are missing or should not be there.
  [[nodiscard]] double contact_error() const;
  /// How much further apart than the closest two vertices those are that are named: mean over pairs of
  /// objects and frames, in mean edge lengths.
  [[nodiscard]] double distance_error() const { return result.above.mean(); }
};

/// A scene, and every setting on it. The first of each question is exact mode.
struct SpeedResults {
  std::string name, title;
  std::size_t objects = 0, vertices = 0, frames = 0;
  double edge_length = 0;
  double contact_distance = 0;
  VertexTruth truth;
  std::vector<SpeedMeasure> measures;
};

SpeedResults measure_speed(SpeedScene scene, const ExperimentOptions& options);

}  // namespace graze::tools
