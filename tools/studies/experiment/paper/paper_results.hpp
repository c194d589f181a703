#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "experiment/paper/paper_rows.hpp"
#include "experiment/paper/paper_walk.hpp"
#include "experiment/paper/played_setting.hpp"

namespace graze::tools {

inline double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// How the paper's numbers are read.
enum class Reading : std::uint8_t {
  pair,           ///< a row's numbers are eq. 4's, for the two objects of a pair. Leaves go to DV untested
  tested_leaves,  ///< so, but two leaves, too, have to pass eq. 4 before DV
  summed,         ///< a row's numbers are each object's, and eq. 4's are their sums (eq. 6)
};

/// The results of a row in one step, over all pairs of objects. A collision is a pair of leaf regions.
struct StepCount {
  std::uint64_t truth = 0;     ///< leaf pairs with vertices nearer than the row's last number
  std::uint64_t reported = 0;  ///< leaf pairs for which DV ends nearer than that
  std::uint64_t missed = 0;    ///< of the truth, not reported
  std::uint64_t extra = 0;     ///< reported, and not of the truth
  std::uint64_t contacts = 0;  ///< different vertex pairs that DV ends at
  std::uint64_t given_to_dv = 0;
  [[nodiscard]] std::uint64_t found() const { return truth - missed; }
  std::array<std::uint64_t, PaperFound::most_levels> passed{};    ///< eq. 4, by level
  std::array<std::uint64_t, PaperFound::most_levels> expanded{};  ///< by level
};

struct RowResult {
  PaperRow row;
  Reading reading = Reading::pair;
  std::vector<StepCount> steps;

  [[nodiscard]] std::uint64_t sum(std::uint64_t StepCount::*count) const {
    std::uint64_t sum = 0;
    for (const StepCount& step : steps) sum += step.*count;
    return sum;
  }
  /// Leaf pairs of the truth that are reported.
  [[nodiscard]] std::uint64_t found() const { return sum(&StepCount::truth) - sum(&StepCount::missed); }
  [[nodiscard]] std::uint64_t passed(std::size_t level) const {
    std::uint64_t sum = 0;
    for (const StepCount& step : steps) sum += step.passed[level];
    return sum;
  }
};

/// Exact mode, or within, against the truth.
struct ContactCheck {
  std::string name;
  ContactDetail detail = ContactDetail::regions;
  double contact_distance = 0;
  std::uint64_t compared = 0;  ///< pairs of objects in all steps
  std::uint64_t wrong = 0;     ///< of those, with recall or precision below 1
  std::uint64_t contacts_true = 0;
  std::uint64_t contacts_reported = 0;
  std::uint64_t contacts_found = 0;   ///< of the true ones
  std::uint64_t distances = 0;        ///< of pairs of objects in all steps
  std::uint64_t distances_wrong = 0;  ///< of those, bounds without the truth between them
  double widest = 0;                  ///< upper - lower
  // What the library did for it, in all steps.
  std::array<std::uint64_t, PaperFound::most_levels> expanded{};
  std::uint64_t leaf_pairs = 0;
};

/// Vertices that leave their region's initial epsilon, of one kind and level.
struct EscapeCount {
  std::string kind;
  std::uint32_t level = 0;
  double epsilon = 0;               ///< eq. 3 in the first frame, the largest of the kind's objects
  std::uint64_t vertices = 0;       ///< in regions of this level, in all frames after the first
  std::uint64_t outside_own = 0;    ///< further from the middle vertex than their region's eq. 2 in frame 0
  std::uint64_t outside_level = 0;  ///< further than eq. 3 of the level in frame 0
  double furthest = 0;              ///< distance from the middle vertex by the region's own initial epsilon
};

/// How many pairs of regions of a level the pairs of objects expand in a step, where any.
struct ExpansionCount {
  std::uint64_t cases = 0;  ///< pairs of objects and steps with any expanded
  std::uint64_t below_thirty = 0;
  std::uint64_t most = 0;
};

struct SettingTime {
  std::string name;
  ContactDetail detail = ContactDetail::regions;
  double contact_distance = 0;
  std::vector<double> step_ms;

  [[nodiscard]] double mean() const;
  [[nodiscard]] double worst() const { return *std::ranges::max_element(step_ms); }
};

/// All that was measured in one experiment, or a variant of it.
struct PaperResults {
  std::vector<RowResult> rows;      ///< read as `pair`, in the tables' order
  RowResult formula;                ///< eq. 3 and 6
  std::vector<RowResult> readings;  ///< the others
  ExpansionCount level_1;           ///< of the best row
  ExpansionCount level_2;           ///< those that pass eq. 4
  std::vector<ContactCheck> checks;
  std::vector<EscapeCount> escapes;
  std::vector<SettingTime> times;
  std::vector<std::string> violations;  ///< where the library does not say what it should
};

}  // namespace graze::tools
