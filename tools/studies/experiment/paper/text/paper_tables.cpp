#include "experiment/paper/text/paper_tables.hpp"

#include <graze/io/scene_file.hpp>
#include <set>

#include "experiment/paper/paper_walk.hpp"

namespace graze::tools {
namespace {

std::vector<const RowResult*> rows_and_formula(const PaperResults& results) {
  std::vector<const RowResult*> rows;
  for (const RowResult& row : results.rows) rows.push_back(&row);
  rows.push_back(&results.formula);
  return rows;
}

std::string numbers_of(const PaperResults& results, const RowResult& row) {
  return &row == &results.formula ? "by each pair's shapes" : row.row.numbers();
}

ResultTable shapes_table(const RecordedMotion& motion) {
  ResultTable table{"shapes", "The shapes, and ε by eq. 3 in the first step",
                    columns_of({"kind", "objects", "vertices", "faces", "edges", "level_1: ε of level 1",
                                "level_2: ε of level 2", "level_3: ε of level 3", "leaves: leaf regions"})};
  std::set<std::string> seen;
  for (const RecordedObject& object : motion.objects) {
    if (!seen.insert(object.kind).second) continue;
    std::uint64_t count = 0;
    for (const RecordedObject& other : motion.objects) count += other.kind == object.kind ? 1U : 0U;
    const PlacedObject placed(object, 0);
    const auto radius = [&](std::size_t level) -> Cell {
      if (level < placed.level_radii().size()) return placed.level_radii()[level];
      return std::string("none");
    };
    table.rows.push_back({object.kind, count, std::uint64_t{object.mesh->vertex_count()},
                          std::uint64_t{object.mesh->face_count()}, std::uint64_t{object.mesh->edge_count()},
                          radius(1), radius(2), radius(3), std::uint64_t{placed.leaves().size()}});
  }
  return table;
}

ResultTable rows_table(const PaperResults& results) {
  ResultTable table{"rows", "Collisions of all steps together",
                    columns_of({"row", "epsilon: ε of level 1 / 2 / last step", "truth: collisions (truth)",
                                "found", "missed", "missed_percent: missed, %", "reported: reported by DV",
                                "extra: reported, no collision", "contacts: different vertex pairs"})};
  for (const RowResult* row : rows_and_formula(results)) {
    const std::uint64_t truth = row->sum(&StepCount::truth);
    const std::uint64_t missed = row->sum(&StepCount::missed);
    table.rows.push_back({row->row.name, numbers_of(results, *row), truth, row->found(), missed,
                          percent(missed, truth), row->sum(&StepCount::reported), row->sum(&StepCount::extra),
                          row->sum(&StepCount::contacts)});
  }
  return table;
}

ResultTable last_step_table(const PaperResults& results) {
  ResultTable table{"last_step", "The last step",
                    columns_of({"row", "truth: collisions (truth)", "found", "reported: reported by DV",
                                "passed_1: region pairs that pass eq. 4, level 1",
                                "passed_2: that pass, level 2", "expanded_1: region pairs expanded, level 1",
                                "expanded_2: expanded, level 2", "given_to_dv: leaf pairs given to DV"})};
  for (const RowResult* row : rows_and_formula(results)) {
    const StepCount& last = row->steps.back();
    table.rows.push_back({row->row.name, last.truth, last.found(), last.reported, last.passed[1],
                          last.passed[2], last.expanded[1], last.expanded[2], last.given_to_dv});
  }
  return table;
}

std::string name_of(Reading reading) {
  if (reading == Reading::pair) return "as in eq. 4";
  return reading == Reading::tested_leaves ? "leaves tested, too" : "summed as in eq. 6";
}

ResultTable readings_table(const PaperResults& results) {
  ResultTable table{"readings", "Other readings of the paper's numbers; all steps together",
                    columns_of({"reading", "row", "truth: collisions (truth)", "found", "missed",
                                "missed_percent: missed, %", "reported: reported by DV",
                                "passed_1: region pairs that pass eq. 4, level 1",
                                "passed_2: that pass, level 2", "given_to_dv: leaf pairs given to DV"})};
  std::vector<const RowResult*> rows;
  for (const RowResult& row : results.rows) rows.push_back(&row);
  for (const RowResult& row : results.readings) rows.push_back(&row);
  for (const RowResult* row : rows) {
    const std::uint64_t truth = row->sum(&StepCount::truth);
    const std::uint64_t missed = row->sum(&StepCount::missed);
    table.rows.push_back({name_of(row->reading), row->row.name, truth, row->found(), missed,
                          percent(missed, truth), row->sum(&StepCount::reported), row->passed(1),
                          row->passed(2), row->sum(&StepCount::given_to_dv)});
  }
  return table;
}

ResultTable checks_table(const PaperResults& results) {
  ResultTable table{
      "contacts", "Exact mode and within against the truth",
      columns_of({"setting", "detail", "contact_distance", "compared: pairs of objects compared",
                  "contacts: contacts (truth)", "recall_percent: recall, %",
                  "precision_percent: precision, %", "wrong: pairs with a wrong or missing contact",
                  "distances: distances compared", "distances_wrong", "widest: widest bounds",
                  "expanded_1: regions expanded, level 1", "expanded_2: expanded, level 2",
                  "leaf_pairs: leaf pairs tested"})};
  const auto share = [](std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 100.0 : percent(part, whole);
  };
  for (const ContactCheck& check : results.checks)
    table.rows.push_back(
        {check.name, std::string(to_string(check.detail)), check.contact_distance, check.compared,
         check.contacts_true, share(check.contacts_found, check.contacts_true),
         share(check.contacts_found, check.contacts_reported), check.wrong, check.distances,
         check.distances_wrong, check.widest, check.expanded[1], check.expanded[2], check.leaf_pairs});
  return table;
}

ResultTable escapes_table(const PaperResults& results) {
  ResultTable table{
      "escapes", "Vertices that leave the ε of the first step",
      columns_of({"kind", "level", "epsilon: ε of the level (eq. 3)",
                  "vertices: vertices, in all later steps", "outside_own: outside ε of their region (eq. 2)",
                  "outside_own_percent: outside ε of their region, %",
                  "outside_level: outside ε of the level (eq. 3)",
                  "outside_level_percent: outside ε of the level, %",
                  "furthest: furthest, in ε of its region"})};
  for (const EscapeCount& count : results.escapes)
    table.rows.push_back({count.kind, std::uint64_t{count.level}, count.epsilon, count.vertices,
                          count.outside_own, percent(count.outside_own, count.vertices), count.outside_level,
                          percent(count.outside_level, count.vertices), count.furthest});
  return table;
}

double mean_of_last_tenth(const std::vector<double>& values) {
  const std::size_t count = (values.size() + 9) / 10;
  double sum = 0;
  for (std::size_t i = values.size() - count; i < values.size(); ++i) sum += values[i];
  return sum / static_cast<double>(count);
}

ResultTable times_table(const PaperResults& results) {
  ResultTable table{
      "times",
      "Time of a step on one thread, in ms",
      columns_of({"setting", "detail", "contact_distance: last ε, or contact distance", "mean_ms: mean",
                  "last_tenth_ms: mean of the last tenth of the steps", "worst_ms: worst"}),
      {},
      true};
  for (const SettingTime& time : results.times)
    table.rows.push_back({time.name, std::string(to_string(time.detail)), time.contact_distance, time.mean(),
                          mean_of_last_tenth(time.step_ms), time.worst()});
  return table;
}

ResultTable steps_table(const PaperResults& results) {
  ResultTable table{
      "steps",
      "Every step of every row",
      columns_of({"step", "row", "truth: collisions there are", "found", "missed", "reported: reported by DV",
                  "extra: that are none", "contacts: different vertex pairs", "passed_1: pass eq. 4, level 1",
                  "passed_2: level 2", "expanded_1: expanded, level 1", "expanded_2: level 2",
                  "given_to_dv: leaf pairs given to DV"}),
      {},
      false,
      false};
  for (const RowResult* row : rows_and_formula(results))
    for (std::size_t step = 0; step < row->steps.size(); ++step) {
      const StepCount& count = row->steps[step];
      table.rows.push_back({std::uint64_t{step + 1}, row->row.name, count.truth, count.found(), count.missed,
                            count.reported, count.extra, count.contacts, count.passed[1], count.passed[2],
                            count.expanded[1], count.expanded[2], count.given_to_dv});
    }
  return table;
}

}  // namespace

std::vector<ResultTable> tables_of(const RecordedMotion& motion, const PaperResults& results,
                                   const std::string& prefix, const std::string& of) {
  std::vector<ResultTable> tables = {shapes_table(motion), rows_table(results), last_step_table(results)};
  if (!results.readings.empty()) tables.push_back(readings_table(results));
  tables.push_back(checks_table(results));
  tables.push_back(escapes_table(results));
  if (!results.times.empty()) tables.push_back(times_table(results));
  tables.push_back(steps_table(results));
  for (ResultTable& table : tables) {
    table.name = prefix + table.name;
    table.title += of;
  }
  return tables;
}

}  // namespace graze::tools
