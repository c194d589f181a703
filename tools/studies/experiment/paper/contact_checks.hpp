#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <vector>

#include "experiment/paper/paper_results.hpp"
#include "experiment/paper/paper_walk.hpp"
#include "experiment/paper/played_setting.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// Compares exact mode and within in every step with all pairs of vertices: the contacts of `regions` and
/// `vertices`, and the distances of pairs of objects.
class ContactChecks {
 public:
  /// `regions` is checked at each of `distances`, the others at the largest. `motion` must outlive it.
  ContactChecks(const RecordedMotion& motion, const std::set<double>& distances);

  /// Plays a frame to all settings.
  void step(std::size_t frame);
  /// Compares objects a and b in that frame. `walk` is theirs.
  void check(PaperWalk& walk, std::size_t a, std::size_t b);

  [[nodiscard]] std::vector<ContactCheck> results() const;
  [[nodiscard]] std::vector<PlayedSetting> settings() const;

 private:
  struct Checked {
    PlayedSetting setting;
    ContactCheck result;
    std::unique_ptr<PlayedMotion> scene;
    ReportHandle report;
  };
  void add(const RecordedMotion& motion, const PlayedSetting& setting);

  std::vector<Checked> checked_;
};

/// Adds what a step did.
void count_work(const StepStatistics& statistics, ContactCheck& check);

/// Tallies one pair's contacts against the true ones. Both are sorted, each once.
template <typename Name>
void tally_contacts(const std::vector<Name>& truth, const std::vector<Name>& reported, ContactCheck& check) {
  std::vector<Name> found;
  std::ranges::set_intersection(truth, reported, std::back_inserter(found));
  ++check.compared;
  check.wrong += found.size() == truth.size() && found.size() == reported.size() ? 0U : 1U;
  check.contacts_true += truth.size();
  check.contacts_reported += reported.size();
  check.contacts_found += found.size();
}

}  // namespace graze::tools
