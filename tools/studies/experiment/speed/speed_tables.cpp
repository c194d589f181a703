#include "experiment/speed/speed_tables.hpp"

#include <algorithm>

#include "experiment/speed/speed_figures.hpp"

namespace graze::tools {
namespace {

const char* word_of(SpeedQuestion question) {
  return question == SpeedQuestion::contacts ? "contacts" : "distances";
}

double mean_of(std::uint64_t sum, std::size_t count) {
  return static_cast<double>(sum) / static_cast<double>(count);
}

ResultTable scene_table(std::span<const SpeedResults> scenes) {
  ResultTable table{
      "scenes", "The scenes",
      columns_of({"scene", "objects", "vertices", "frames", "contact_distance",
                  "edge_length: mean edge length", "contacts_per_step: contacts a step",
                  "pairs_checked: pairs of objects checked by brute force",
                  "contacts_checked: contacts of these pairs", "wrong: of these pairs, wrong"})};
  for (const SpeedResults& scene : scenes)
    table.rows.push_back({scene.title, std::uint64_t{scene.objects}, std::uint64_t{scene.vertices},
                          std::uint64_t{scene.frames}, scene.contact_distance, scene.edge_length,
                          mean_of(scene.measures.front().result.contacts_true, scene.frames),
                          scene.truth.pairs, scene.truth.contacts, scene.truth.wrong});
  return table;
}

ResultTable answer_table(std::span<const SpeedResults> scenes) {
  ResultTable table{
      "answers", "What each setting answers",
      columns_of({"scene", "question", "mode", "setting", "pairs_complete", "contacts_true: true contacts",
                  "contacts_reported", "contacts_found: true contacts reported", "recall", "precision",
                  "contact_error: missing or wrong", "distance_error_mean: distance error, mean (edges)",
                  "distance_error_largest: distance error, largest (edges)",
                  "bounds_width_mean: width of bounds, mean (edges)",
                  "region_pairs_per_step: region pairs a step"})};
  table.shown = false;
  for (const SpeedResults& scene : scenes)
    for (const SpeedMeasure& measure : scene.measures) {
      if (measure.is_timed) continue;
      const ModeResult& result = measure.result;
      table.rows.push_back(
          {scene.title, word_of(measure.question), title_of(result.setting.family), result.setting.name,
           result.complete_rows, result.contacts_true, result.contacts_reported, result.contacts_found,
           result.recall(), result.precision(), measure.contact_error(), result.above.mean(),
           result.above.largest(), result.width.mean(), mean_of(result.region_pairs, scene.frames)});
    }
  return table;
}

/// Returns the columns that show the errors of the answers to a question.
std::vector<Column> error_columns(SpeedQuestion question) {
  if (question == SpeedQuestion::distances)
    return columns_of({"distance_error_mean: distance error, mean (edges)",
                       "distance_error_largest: distance error, largest (edges)",
                       "bounds_width_mean: width of bounds, mean (edges)"});
  return columns_of({"recall", "precision", "contact_error: missing or wrong"});
}

void add_errors(const SpeedMeasure& measure, std::vector<Cell>& row) {
  const ModeResult& result = measure.result;
  if (measure.question == SpeedQuestion::distances) {
    row.insert(row.end(), {result.above.mean(), result.above.largest(), result.width.mean()});
  } else {
    row.insert(row.end(), {result.recall(), result.precision(), measure.contact_error()});
  }
}

bool is_on_front(const SpeedMeasure& measure) {
  return measure.on_contact_front || measure.on_distance_front;
}

std::vector<const SpeedMeasure*> by_time(const SpeedResults& scene, SpeedQuestion question) {
  std::vector<const SpeedMeasure*> measures;
  for (const SpeedMeasure& measure : scene.measures)
    if (measure.question == question) measures.push_back(&measure);
  std::ranges::stable_sort(measures, {}, [](const SpeedMeasure* measure) { return measure->result.step_ms; });
  return measures;
}

/// Every setting, or those on the front, the fastest first.
ResultTable time_table(std::span<const SpeedResults> scenes, SpeedQuestion question, bool only_front) {
  ResultTable table{
      std::string(word_of(question)) + (only_front ? "_front" : "_times"),
      question == SpeedQuestion::contacts ? "Contacts: the Pareto fronts" : "Distances: the Pareto fronts",
      columns_of({"scene", "setting", "ms: ms a step", "relative_ms: time / exact mode's"}),
      {},
      true,
      only_front};
  const std::vector<Column> errors = error_columns(question);
  table.columns.insert(table.columns.end(), errors.begin(), errors.end());
  if (!only_front) table.columns.push_back({"on_front", "on the front"});
  for (const SpeedResults& scene : scenes)
    for (const SpeedMeasure* measure : by_time(scene, question)) {
      if (only_front && !is_on_front(*measure)) continue;
      std::vector<Cell> row = {scene.title, measure->result.setting.name, measure->result.step_ms,
                               measure->relative_ms};
      add_errors(*measure, row);
      if (!only_front) row.emplace_back(std::uint64_t{is_on_front(*measure) ? 1U : 0U});
      table.rows.push_back(std::move(row));
    }
  return table;
}

ResultTable mean_table(std::span<const SpeedResults> scenes, SpeedQuestion question) {
  const bool is_contacts = question == SpeedQuestion::contacts;
  ResultTable table{std::string(word_of(question)) + "_means",
                    is_contacts ? "Contacts: means over all scenes (times: geometric means)"
                                : "Distances: means over all scenes (times: geometric means)",
                    columns_of({"setting", "relative_ms: time / exact mode's"}),
                    {},
                    true};
  if (is_contacts) {
    const std::vector<Column> errors = error_columns(question);
    table.columns.insert(table.columns.end(), errors.begin(), errors.end());
  } else {
    table.columns.push_back({"distance_error", "distance error (edges)"});
  }
  for (const SpeedMean& mean : means_of(scenes)) {
    if (mean.question != question) continue;
    std::vector<Cell> row = {mean.setting, mean.relative_ms};
    if (is_contacts)
      row.insert(row.end(), {mean.recall, mean.precision, mean.contact_error});
    else
      row.emplace_back(mean.distance_error);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<ResultTable> speed_tables(std::span<const SpeedResults> scenes) {
  return {scene_table(scenes),
          mean_table(scenes, SpeedQuestion::contacts),
          mean_table(scenes, SpeedQuestion::distances),
          time_table(scenes, SpeedQuestion::contacts, true),
          time_table(scenes, SpeedQuestion::distances, true),
          answer_table(scenes),
          time_table(scenes, SpeedQuestion::contacts, false),
          time_table(scenes, SpeedQuestion::distances, false)};
}

}  // namespace graze::tools
