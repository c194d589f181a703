#pragma once

#include <cstdint>
#include <graze/graze.hpp>
#include <string>
#include <vector>

#include "experiment/paper/paper_rows.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// A scene's settings, and thresholds for kinds of pairs.
struct PlayedSetting {
  std::string name;
  SceneSettings settings;
  std::vector<RowRule> rules;  ///< whose last number is the kinds' contact distance, too
};

/// A row of the paper's tables as a setting: its numbers by rules, every pair of objects looked at in every
/// step as in the paper, one thread.
PlayedSetting setting_of(const PaperRow& row);
/// The numbers from eq. 3, summed as in eq. 6.
PlayedSetting formula_setting(double contact_distance);
/// Exact mode with the distances of all pairs, or, with `range` 0, of what is in contact only.
PlayedSetting exact_setting(ContactDetail detail, double contact_distance, double range);
/// The mode `within(tolerance)` with the distances of all pairs.
PlayedSetting within_setting(ContactDetail detail, double contact_distance, double tolerance);

/// A recorded motion in a scene of its own.
class PlayedMotion {
 public:
  /// `motion` must outlive it.
  PlayedMotion(const RecordedMotion& motion, const PlayedSetting& setting);

  /// Brings every object to where it is in `frame`, and steps.
  ReportHandle step(std::size_t frame);
  /// The row of two objects, the one that was recorded first before the other. Null where none is listed.
  [[nodiscard]] const PairReport* row(const FrameReport& report, std::size_t a, std::size_t b) const;
  /// How long the last call's Scene::step took.
  [[nodiscard]] double step_ms() const { return step_ms_; }

 private:
  const RecordedMotion& motion_;
  Scene scene_;
  std::vector<ObjectId> ids_;
  double step_ms_ = 0;
};

/// ms of each frame's step: the fastest of `runs` runs through the whole motion.
std::vector<double> step_times(const RecordedMotion& motion, const PlayedSetting& setting,
                               std::uint32_t runs);

}  // namespace graze::tools
