#include "experiment/speed/speed_measures.hpp"

#include <array>
#include <utility>

#include "experiment/speed/pareto.hpp"
#include "experiment/speed/recorded_scene.hpp"
#include "progress.hpp"

namespace graze::tools {
namespace {

/// Measures the settings for one question about a scene.
class QuestionStudy {
 public:
  QuestionStudy(const RecordedScene& scene, const ModeStudy& study, SpeedQuestion question, bool with_times)
      : scene_(scene), study_(study), question_(question) {
    const double distance = study.contact_distance();
    const ModeSetting exact_setting = exact_speed_setting(question, distance);
    const ModeResult exact = study.measure(exact_setting, 1);
    settings_ = speed_settings(scene, question, distance, exact.most_region_pairs);
    settings_.insert(settings_.begin(), exact_setting);
    untimed_ = settings_.size();
    if (!with_times) return;
    const std::vector<ModeSetting> timed = timed_speed_settings(question, distance, exact.longest_step_ms);
    settings_.insert(settings_.end(), timed.begin(), timed.end());
  }

  /// Every setting in each round, so that what else the machine does meets all alike.
  [[nodiscard]] std::vector<SpeedMeasure> measure(std::uint32_t rounds) const {
    std::vector<SpeedMeasure> measures(settings_.size());
    Progress progress(scene_.motion().name + ": setting", rounds * settings_.size());
    for (std::uint32_t round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < settings_.size(); ++i) {
        progress.at(round * settings_.size() + i);
        const ModeResult result = study_.measure(settings_[i], 1);
        if (round == 0 || result.step_ms < measures[i].result.step_ms)
          measures[i] = {question_, result, i >= untimed_};
      }
    for (SpeedMeasure& measure : measures)
      measure.relative_ms = measure.result.step_ms / measures.front().result.step_ms;
    return measures;
  }

 private:
  const RecordedScene& scene_;
  const ModeStudy& study_;
  SpeedQuestion question_;
  std::vector<ModeSetting> settings_;  ///< the first is exact mode
  std::size_t untimed_ = 0;            ///< how many come before those that hang on times
};

template <typename ErrorOf>
void mark_front(std::vector<SpeedMeasure>& measures, SpeedQuestion question, bool SpeedMeasure::*on_front,
                const ErrorOf& error_of) {
  std::vector<std::size_t> places;
  std::vector<CostAndError> points;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    if (measures[i].question != question) continue;
    places.push_back(i);
    points.push_back({measures[i].result.step_ms, error_of(measures[i])});
  }
  for (const std::size_t i : pareto_front(points)) measures[places[i]].*on_front = true;
}

}  // namespace

double SpeedMeasure::contact_error() const {
  const std::uint64_t all = result.contacts_true + result.contacts_reported - result.contacts_found;
  return all == 0 ? 0 : 1 - static_cast<double>(result.contacts_found) / static_cast<double>(all);
}

SpeedResults measure_speed(SpeedScene speed_scene, const ExperimentOptions& options) {
  const RecordedScene scene(std::move(speed_scene.motion));
  const ModeStudy study(scene, speed_scene.contact_distance);
  SpeedResults results{speed_scene.name,
                       speed_scene.title,
                       scene.size(),
                       0,
                       scene.frame_count(),
                       scene.mean_edge_length(),
                       speed_scene.contact_distance,
                       {},
                       {}};
  for (std::size_t body = 0; body < scene.size(); ++body)
    results.vertices += scene.mesh(body)->vertex_count();
  results.truth = check_vertex_truth(scene.motion(), study, 3);
  for (const SpeedQuestion question : {SpeedQuestion::contacts, SpeedQuestion::distances}) {
    const auto measures = QuestionStudy(scene, study, question, options.times).measure(options.runs);
    results.measures.insert(results.measures.end(), measures.begin(), measures.end());
  }
  mark_front(results.measures, SpeedQuestion::contacts, &SpeedMeasure::on_contact_front,
             [](const SpeedMeasure& measure) { return measure.contact_error(); });
  mark_front(results.measures, SpeedQuestion::distances, &SpeedMeasure::on_distance_front,
             [](const SpeedMeasure& measure) { return measure.distance_error(); });
  return results;
}

}  // namespace graze::tools
