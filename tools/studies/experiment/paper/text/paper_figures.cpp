#include "experiment/paper/text/paper_figures.hpp"

#include <array>
#include <map>
#include <optional>

#include "output/text.hpp"

namespace graze::tools {
namespace {

template <typename ValueOf>
Series series_of(const RowResult& row, const std::string& name, const ValueOf& value_of) {
  Series series{name};
  for (std::size_t step = 0; step < row.steps.size(); ++step)
    series.add(static_cast<double>(step + 1), static_cast<double>(value_of(row.steps[step])));
  return series;
}

std::string title_of(const RowResult& row) {
  return row.row.name + ": " + row.row.numbers();
}

/// Exact mode and the truth have the first look in every figure. Each row of the paper has its own.
constexpr std::size_t exact_look = 0, formula_look = 6, all_distances_look = 7;
constexpr std::array<std::size_t, 5> row_looks = {2, 3, 1, 4, 5};

/// That look with other dashes.
constexpr std::size_t dashed(std::size_t look) {
  return look + colour_count;
}

/// The truth, once for each last number there is.
std::vector<Series> truths_of(const PaperResults& results) {
  std::map<double, const RowResult*> rows;
  for (const RowResult& row : results.rows) rows.emplace(row.row.last(), &row);
  std::vector<Series> truths;
  truths.reserve(rows.size());
  for (const auto& [last, row] : rows) {
    truths.push_back(series_of(*row, format("all, exact mode at %g", last),
                               [](const StepCount& step) { return step.truth; }));
    truths.back().look = truths.size() == 1 ? exact_look : dashed(exact_look);
  }
  return truths;
}

/// A count of each row in each step, beside the truth.
template <typename CountOf>
Figure steps_figure(const PaperResults& results, const char* name, const char* title, const CountOf& count) {
  Figure figure{name,  title, "step", "collisions (pairs of leaf regions)",
                false, false, false,  truths_of(results)};
  figure.named_at_ends = true;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    figure.series.push_back(series_of(results.rows[i], title_of(results.rows[i]), count));
    figure.series.back().look = row_looks.at(i);
  }
  return figure;
}

Figure found_figure(const PaperResults& results) {
  return steps_figure(results, "found",
                      "Leaf regions with vertices nearer than the last ε: found by each row, and all",
                      [](const StepCount& step) { return step.found(); });
}

Figure reported_figure(const PaperResults& results) {
  return steps_figure(results, "reported",
                      "Leaf regions for which DV ends nearer than the last ε, and those truly so near",
                      [](const StepCount& step) { return step.reported; });
}

/// The look of a setting that is drawn: the paper's best row, the paper's formula, and exact mode for the
/// same question and for all distances. More lines could not be followed.
std::optional<std::size_t> look_of(const SettingTime& time, const PaperResults& results) {
  const PaperRow& best = results.rows[best_row].row;
  if (time.name == best.name) return row_looks[best_row];
  if (time.name == results.formula.row.name) return formula_look;
  if (time.name == "exact, all distances") return all_distances_look;
  if (time.name == "exact" && time.contact_distance == best.last()) return exact_look;
  return std::nullopt;
}

/// Medians of about a twelfth of all steps show how times grow.
std::size_t steps_of_median(const PaperResults& results) {
  return results.times.front().step_ms.size() / 12 | 1U;
}

Figure times_figure(const PaperResults& results) {
  Figure figure{"times",
                "Time of each step on one thread: points, and their running median",
                "step",
                "time of a step (ms)",
                false,
                true,
                true,
                {},
                steps_of_median(results),
                true};
  for (const SettingTime& time : results.times) {
    if (time.detail != ContactDetail::regions) continue;
    Series series{format("%s at %g", time.name.c_str(), time.contact_distance)};
    series.look = look_of(time, results);
    series.drawn = series.look.has_value();
    for (std::size_t step = 0; step < time.step_ms.size(); ++step)
      series.add(static_cast<double>(step + 1), time.step_ms[step]);
    figure.series.push_back(std::move(series));
  }
  return figure;
}

}  // namespace

std::vector<Figure> figures_of(const PaperResults& results, const std::string& prefix,
                               const std::string& of) {
  std::vector<Figure> figures = {found_figure(results), reported_figure(results)};
  if (!results.times.empty()) figures.push_back(times_figure(results));
  for (Figure& figure : figures) {
    figure.name = prefix + figure.name;
    figure.title += of;
  }
  return figures;
}

}  // namespace graze::tools
