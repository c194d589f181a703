#include "experiment/speed_measures.hpp"

#include <array>
#include <utility>

#include "experiment/pareto.hpp"
#include "experiment/recorded_scene.hpp"
#include "progress.hpp"

namespace graze::tools {
namespace {

void measure_question(const RecordedScene& scene, const ModeStudy& study, SpeedQuestion question,
                      const ExperimentOptions& options, std::vector<SpeedMeasure>& measures) {
  const double distance = study.contact_distance();
  const ModeResult exact = study.measure(exact_speed_setting(question, distance), options.runs);
  measures.push_back({question, exact, false, 1});
  std::vector<ModeSetting> settings = speed_settings(scene, question, distance, exact.most_region_pairs);
  const std::size_t untimed = settings.size();
  if (options.times) {
    const std::vector<ModeSetting> timed = timed_speed_settings(question, distance, exact.longest_step_ms);
    settings.insert(settings.end(), timed.begin(), timed.end());
  }
  Progress progress(scene.motion().name + ": setting", settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    progress.at(i);
    const ModeResult result = study.measure(settings[i], options.runs);
    measures.push_back({question, result, i >= untimed, result.step_ms / exact.step_ms});
  }
}

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
  for (const SpeedQuestion question : {SpeedQuestion::contacts, SpeedQuestion::distances})
    measure_question(scene, study, question, options, results.measures);
  mark_front(results.measures, SpeedQuestion::contacts, &SpeedMeasure::on_contact_front,
             [](const SpeedMeasure& measure) { return measure.contact_error(); });
  mark_front(results.measures, SpeedQuestion::distances, &SpeedMeasure::on_distance_front,
             [](const SpeedMeasure& measure) { return measure.distance_error(); });
  return results;
}

}  // namespace graze::tools
