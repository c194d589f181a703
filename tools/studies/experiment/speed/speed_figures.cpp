#include "experiment/speed/speed_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/speed/pareto.hpp"

namespace graze::tools {
namespace {

/// The families in the order in which they are drawn: the last is drawn over the others.
constexpr std::array<ModeFamily, 7> families = {
    ModeFamily::work_budget,   ModeFamily::time_budget, ModeFamily::paper_loose, ModeFamily::paper_numbers,
    ModeFamily::paper_formula, ModeFamily::within,      ModeFamily::exact};

struct Point {
  ModeFamily family;
  std::string setting;
  double x, y;
};

Series front_of(const std::vector<Point>& points, bool less_is_better) {
  std::vector<CostAndError> costs;
  costs.reserve(points.size());
  for (const Point& point : points) costs.push_back({point.x, less_is_better ? point.y : -point.y});
  Series front{"Pareto front", {}, {}, true, {}, false};
  for (const std::size_t i : pareto_front(costs)) {
    front.add(points[i].x, points[i].y);
    front.labels.push_back(points[i].setting);
  }
  return front;
}

/// The front, and a series for each family, of points alone.
std::vector<Series> series_of(const std::vector<Point>& points, bool less_is_better) {
  std::vector<Series> all = {front_of(points, less_is_better)};
  for (const ModeFamily family : families) {
    Series series{title_of(family), {}, {}, false};
    for (const Point& point : points)
      if (point.family == family) series.add(point.x, point.y);
    all.push_back(std::move(series));
  }
  return all;
}

std::vector<Point> points_of(std::span<const SpeedMean> means, SpeedQuestion question,
                             double SpeedMean::*error) {
  std::vector<Point> points;
  for (const SpeedMean& mean : means)
    if (mean.question == question)
      points.push_back({mean.family, mean.setting, mean.relative_ms, mean.*error});
  return points;
}

constexpr const char* relative_time = "time of a step ÷ time of exact mode (geometric mean over the scenes)";
constexpr const char* missing_or_wrong = "share of contacts missing or wrong";
constexpr const char* recall_title = "recall (share of the true contacts that are reported)";
constexpr const char* precision_title = "precision (share of the reported contacts that are true)";
constexpr const char* too_far = "distance given − true distance, mean (edge lengths)";

std::vector<Figure> mean_figures(std::span<const SpeedMean> means) {
  const auto contacts = [&](double SpeedMean::*error) {
    return points_of(means, SpeedQuestion::contacts, error);
  };
  return {{"contacts", "All scenes: time against contacts that are missing or wrong", relative_time,
           missing_or_wrong, true, true, true, series_of(contacts(&SpeedMean::contact_error), true)},
          {"recall", "All scenes: time against recall of contacts", relative_time, recall_title, true, false,
           true, series_of(contacts(&SpeedMean::recall), false)},
          {"precision", "All scenes: time against precision of contacts", relative_time, precision_title,
           true, false, true, series_of(contacts(&SpeedMean::precision), false)},
          {"distances", "All scenes: time against error of distance", relative_time, too_far, true, true,
           true, series_of(points_of(means, SpeedQuestion::distances, &SpeedMean::distance_error), true)}};
}

template <typename ErrorOf>
std::vector<Series> scene_series(const SpeedResults& scene, SpeedQuestion question, const ErrorOf& error_of) {
  std::vector<Point> points;
  for (const SpeedMeasure& measure : scene.measures)
    if (measure.question == question)
      points.push_back({measure.result.setting.family, measure.result.setting.name, measure.result.step_ms,
                        error_of(measure)});
  return series_of(points, true);
}

void add_scene_figures(const SpeedResults& scene, std::vector<Figure>& figures) {
  figures.push_back({scene.name + "_contacts", scene.title + ": contacts", "time of a step (ms)",
                     missing_or_wrong, true, true, true,
                     scene_series(scene, SpeedQuestion::contacts,
                                  [](const SpeedMeasure& measure) { return measure.contact_error(); })});
  figures.push_back({scene.name + "_distances", scene.title + ": distances", "time of a step (ms)", too_far,
                     true, true, true,
                     scene_series(scene, SpeedQuestion::distances,
                                  [](const SpeedMeasure& measure) { return measure.distance_error(); })});
}

const SpeedMeasure* find(const SpeedResults& scene, const SpeedMeasure& like) {
  const auto found = std::ranges::find_if(scene.measures, [&](const SpeedMeasure& measure) {
    return measure.question == like.question && measure.result.setting.name == like.result.setting.name;
  });
  return found == scene.measures.end() ? nullptr : &*found;
}

SpeedMean mean_of(const std::vector<const SpeedMeasure*>& measures) {
  const ModeSetting& setting = measures.front()->result.setting;
  SpeedMean sum{setting.name, setting.family, measures.front()->question};
  for (const SpeedMeasure* measure : measures) {
    sum.relative_ms *= measure->relative_ms;
    sum.recall += measure->result.recall();
    sum.precision += measure->result.precision();
    sum.contact_error += measure->contact_error();
    sum.distance_error += measure->distance_error();
  }
  const auto count = static_cast<double>(measures.size());
  return {sum.setting,
          sum.family,
          sum.question,
          std::pow(sum.relative_ms, 1 / count),
          sum.recall / count,
          sum.precision / count,
          sum.contact_error / count,
          sum.distance_error / count};
}

}  // namespace

std::vector<SpeedMean> means_of(std::span<const SpeedResults> scenes) {
  std::vector<SpeedMean> means;
  if (scenes.empty()) return means;
  for (const SpeedMeasure& first : scenes.front().measures) {
    std::vector<const SpeedMeasure*> all;
    for (const SpeedResults& scene : scenes)
      if (const SpeedMeasure* measure = find(scene, first)) all.push_back(measure);
    if (all.size() == scenes.size()) means.push_back(mean_of(all));
  }
  return means;
}

std::vector<Figure> speed_figures(std::span<const SpeedResults> scenes) {
  std::vector<Figure> figures = mean_figures(means_of(scenes));
  for (const SpeedResults& scene : scenes) add_scene_figures(scene, figures);
  return figures;
}

}  // namespace graze::tools
