#include "experiment/paper/paper_measures.hpp"

#include <graze/io/scene_file.hpp>
#include <memory>
#include <set>
#include <utility>

#include "experiment/paper/contact_checks.hpp"
#include "experiment/paper/feature_checks.hpp"
#include "experiment/paper/region_escapes.hpp"
#include "progress.hpp"

namespace graze::tools {
namespace {

constexpr std::size_t pairs_expanded_in_general = 30;  // section 3.2

/// Rows are compared with the library in the reading that it follows.
constexpr Reading library_reading = Reading::pair;

PaperNumbers numbers_of(const PaperRow& row, Reading reading, const RecordedObject& a,
                        const RecordedObject& b) {
  const std::vector<double>& epsilon = row.epsilon(a.kind_id, b.kind_id);
  PaperNumbers numbers{
      {epsilon.begin(), epsilon.end() - 1}, epsilon.back(), reading == Reading::tested_leaves};
  if (reading == Reading::summed)
    for (double& number : numbers.epsilon) number *= 2;
  return numbers;
}

/// Vertex pairs that a row's DV ends at in one pair of objects, each once.
using Ends = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Adds what a walk found in one pair of objects to its step.
Ends count(PaperWalk& walk, const PaperFound& found, double last, StepCount& step) {
  const double limit = last * last;
  const std::vector<std::uint32_t> near = walk.near_leaves(last);
  std::vector<bool> reported(walk.leaf_pair_count());
  Ends ends;
  for (const std::uint32_t number : found.reached) {
    const LeafPair& leaves = walk.leaves(number);
    if (!(leaves.walked.squared < limit)) continue;
    reported[number] = true;
    ++step.reported;
    ends.emplace(leaves.walked.a, leaves.walked.b);
    if (!(leaves.nearest.squared < limit)) ++step.extra;
  }
  step.truth += near.size();
  for (const std::uint32_t number : near) step.missed += reported[number] ? 0U : 1U;
  step.contacts += ends.size();
  step.given_to_dv += found.reached.size();
  for (std::size_t level = 0; level < PaperFound::most_levels; ++level) {
    step.passed[level] += found.passed[level];
    step.expanded[level] += found.expanded[level];
  }
  return ends;
}

void count_expansion(std::uint64_t regions, ExpansionCount& count) {
  if (regions == 0) return;
  ++count.cases;
  count.below_thirty += regions < pairs_expanded_in_general ? 1U : 0U;
  count.most = std::max(count.most, regions);
}

/// A row whose answers the library gives, too.
struct LibraryRow {
  RowResult* result = nullptr;
  std::unique_ptr<PlayedMotion> scene;
  ReportHandle report;
};

class Measurement {
 public:
  Measurement(const RecordedMotion& motion, const std::vector<PaperRow>& rows,
              const ExperimentOptions& options, Extent extent)
      : motion_(motion), options_(options), extent_(extent), checks_(motion, distances_of(rows)) {
    for (const PaperRow& row : rows) results_.rows.push_back({row, Reading::pair, {}});
    const std::vector<Reading> others = extent == Extent::all_readings
                                            ? std::vector{Reading::tested_leaves, Reading::summed}
                                            : std::vector<Reading>();
    for (const Reading reading : others)
      for (const PaperRow& row : rows) results_.readings.push_back({row, reading, {}});
    results_.formula.row = {"eq. 3 and 6", rows[best_row].rules};
    for (RowResult& row : results_.rows) add_to_library(row, setting_of(row.row));
    add_to_library(results_.formula, formula_setting(rows[best_row].last()));
  }

  PaperResults run() {
    Progress progress(motion_.name + ": step", motion_.frame_count());
    for (std::size_t frame = 0; frame < motion_.frame_count(); ++frame) {
      progress.at(frame);
      step(frame);
    }
    results_.escapes = count_escapes(motion_);
    results_.checks = checks_.results();
    for (const ContactCheck& check :
         check_features(motion_, feature_distance(), options_.frames == 0 ? 10 : 1))
      results_.checks.push_back(check);
    for (const ContactCheck& check : results_.checks) require(check);
    if (options_.times) measure_times();
    return std::move(results_);
  }

 private:
  static std::set<double> distances_of(const std::vector<PaperRow>& rows) {
    std::set<double> distances;
    for (const PaperRow& row : rows) distances.insert(row.last());
    return distances;
  }

  void add_to_library(RowResult& result, const PlayedSetting& setting) {
    LibraryRow& row = library_.emplace_back();
    row.result = &result;
    row.scene = std::make_unique<PlayedMotion>(motion_, setting);
    settings_.push_back(setting);
  }

  void step(std::size_t frame) {
    for (LibraryRow& row : library_) row.report = row.scene->step(frame);
    checks_.step(frame);
    std::vector<PlacedObject> placed;
    for (const RecordedObject& object : motion_.objects) placed.emplace_back(object, frame);
    for (RowResult* row : all_rows()) row->steps.emplace_back();
    for (std::size_t a = 0; a < placed.size(); ++a)
      for (std::size_t b = a + 1; b < placed.size(); ++b) {
        if (motion_.in_one_group(a, b)) continue;
        PaperWalk walk(placed[a], placed[b]);
        walk_rows(walk, a, b);
        checks_.check(walk, a, b);
      }
    for (const LibraryRow& row : library_) compare_work(row, frame);
  }

  void walk_rows(PaperWalk& walk, std::size_t a, std::size_t b) {
    const RecordedObject& object_a = motion_.objects[a];
    const RecordedObject& object_b = motion_.objects[b];
    for (LibraryRow& row : library_) {
      PaperNumbers numbers = numbers_of(row.result->row, library_reading, object_a, object_b);
      if (row.result == &results_.formula) numbers.epsilon.clear();
      const PaperFound found = walk.find(numbers);
      if (row.result == &results_.rows[best_row]) {
        count_expansion(found.passed[1], results_.level_1);
        count_expansion(found.passed[2], results_.level_2);
      }
      compare(count(walk, found, numbers.last, row.result->steps.back()), row, a, b);
    }
    for (RowResult& row : results_.readings) {
      const PaperNumbers numbers = numbers_of(row.row, row.reading, object_a, object_b);
      count(walk, walk.find(numbers), numbers.last, row.steps.back());
    }
  }

  /// The library's contacts of a pair of objects are the ends of DV, each once.
  void compare(const Ends& expected, const LibraryRow& row, std::size_t a, std::size_t b) {
    Ends found;
    for (const Contact& contact : row.report->contacts(*row.scene->row(*row.report, a, b)))
      found.emplace(contact.feature_a.index, contact.feature_b.index);
    if (found != expected) disagree(row, "contacts");
  }

  /// Compares the counts of the library with this walk's. Steps in which the library skipped pairs because
  /// nothing moved are left out.
  void compare_work(const LibraryRow& row, std::size_t frame) {
    const StepStatistics& statistics = row.report->statistics();
    if (statistics.pairs_unchanged > 0) return;
    const StepCount& step = row.result->steps[frame];
    if (statistics.work.leaf_pairs_tested != step.given_to_dv) disagree(row, "leaf pairs");
    for (std::size_t level = 0; level + 1 < PaperFound::most_levels; ++level)
      if (statistics.work.regions_expanded[level] != step.expanded[level]) disagree(row, "expanded regions");
  }

  void disagree(const LibraryRow& row, const char* what) {
    const std::string text = motion_.name + ", " + row.result->row.name + ": the library's " + what +
                             " are not those of the paper's method written down plainly";
    if (results_.violations.empty() || results_.violations.back() != text)
      results_.violations.push_back(text);
  }

  std::vector<RowResult*> all_rows() {
    std::vector<RowResult*> all = {&results_.formula};
    for (RowResult& row : results_.rows) all.push_back(&row);
    for (RowResult& row : results_.readings) all.push_back(&row);
    return all;
  }

  /// Surfaces are nearer to each other than their vertices.
  [[nodiscard]] double feature_distance() const { return 0.5 * results_.rows.back().row.last(); }

  void require(const ContactCheck& check) {
    const std::string what = motion_.name + ", " + check.name + ", " + std::string(to_string(check.detail));
    if (check.wrong > 0) results_.violations.push_back(what + ": contacts are not those of brute force");
    if (check.distances_wrong > 0)
      results_.violations.push_back(what + ": bounds do not hold the true distance, or are too wide");
  }

  /// Eq. 3 and 6 takes longer than all others together, and so do bodies in parts: one run is enough.
  void measure_times() {
    for (const PlayedSetting& setting : checks_.settings())
      if (setting.settings.detail == ContactDetail::regions) settings_.push_back(setting);
    settings_.push_back(exact_setting(ContactDetail::features, feature_distance(), 0));
    Progress progress(motion_.name + ": times", settings_.size());
    for (const PlayedSetting& setting : settings_) {
      progress.at(results_.times.size());
      const bool is_long = setting.name == results_.formula.row.name || extent_ == Extent::one_reading;
      const std::uint32_t runs = is_long ? 1 : options_.runs;
      results_.times.push_back({setting.name, setting.settings.detail, setting.settings.contact_distance,
                                step_times(motion_, setting, runs)});
    }
  }

  const RecordedMotion& motion_;
  const ExperimentOptions& options_;
  Extent extent_;
  PaperResults results_;
  std::vector<LibraryRow> library_;
  std::vector<PlayedSetting> settings_;
  ContactChecks checks_;
};

}  // namespace

double SettingTime::mean() const {
  double sum = 0;
  for (const double ms : step_ms) sum += ms / static_cast<double>(step_ms.size());
  return sum;
}

PaperResults measure_paper(const RecordedMotion& motion, const std::vector<PaperRow>& rows,
                           const ExperimentOptions& options, Extent extent) {
  return Measurement(motion, rows, options, extent).run();
}

}  // namespace graze::tools
