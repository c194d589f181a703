#pragma once

#include <cstdint>
#include <graze/graze.hpp>
#include <span>
#include <vector>

#include "accuracy/moving_surfaces.hpp"
#include "accuracy/settings.hpp"
#include "accuracy/tally.hpp"

namespace graze::tools {

/// The answers of a setting over all frames, compared with exact mode. Lengths are in mean edge lengths.
struct ModeResult {
  ModeSetting setting;
  std::uint64_t pair_rows = 0;
  std::uint64_t complete_rows = 0;
  std::uint64_t contacts_true = 0;      ///< that exact mode gives in this detail
  std::uint64_t contacts_found = 0;     ///< of those
  std::uint64_t contacts_reported = 0;  ///< those and others
  std::uint64_t contacts_below = 0;     ///< of those reported, truly below the contact distance
  std::uint64_t pairs_true = 0;         ///< pairs of objects in contact
  std::uint64_t pairs_found = 0;        ///< of those
  ErrorTally width;                     ///< upper - lower
  ErrorTally above;                     ///< upper - truth
  ErrorTally below;                     ///< truth - lower
  std::uint64_t broken_bounds = 0;      ///< rows whose bounds do not hold the truth
  std::uint64_t region_pairs = 0;
  std::uint64_t most_region_pairs = 0;  ///< in one frame
  double step_ms = 0;                   ///< mean over the frames of the fastest of some runs
  double longest_step_ms = 0;           ///< the largest of those

  /// The share of true contacts found, and of reported ones that are below the contact distance. Of none it
  /// is 1.
  [[nodiscard]] double recall() const;
  [[nodiscard]] double precision() const;
};

/// Measures settings on bodies in motion.
class ModeStudy {
 public:
  using Reports = std::vector<ReportHandle>;

  /// Runs exact mode in the three details that settings are compared with. `bodies` must outlive the study.
  ModeStudy(const MovingSurfaces& bodies, double contact_distance);

  [[nodiscard]] double contact_distance() const { return contact_distance_; }
  /// The reports of exact mode, one a frame. Every pair of bodies is listed.
  [[nodiscard]] const Reports& truth(ContactDetail detail) const;
  /// Runs a setting `runs` times. Answers are those of the last run. A pair that is not within its range has
  /// no contacts there, and counts for no distance.
  [[nodiscard]] ModeResult measure(const ModeSetting& setting, std::uint32_t runs) const;

 private:
  struct Run {
    Reports reports;
    std::vector<double> step_ms;
  };
  [[nodiscard]] Run run(const SceneSettings& settings) const;
  void compare(const FrameReport& report, const FrameReport& truth, const FrameReport& below,
               ModeResult& result) const;

  const MovingSurfaces& bodies_;
  double contact_distance_;
  Reports features_, regions_, vertices_;
};

}  // namespace graze::tools
