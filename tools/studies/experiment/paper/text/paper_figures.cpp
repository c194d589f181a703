#include "experiment/paper/text/paper_figures.hpp"

#include <map>

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

/// The truth, once for each last number there is.
std::vector<Series> truths_of(const PaperResults& results) {
  std::map<double, const RowResult*> rows;
  for (const RowResult& row : results.rows) rows.emplace(row.row.last(), &row);
  std::vector<Series> truths;
  truths.reserve(rows.size());
  for (const auto& [last, row] : rows)
    truths.push_back(series_of(*row, format("all, exact mode at %g", last),
                               [](const StepCount& step) { return step.truth; }));
  return truths;
}

/// A count of each row in each step, beside the truth.
template <typename CountOf>
Figure steps_figure(const PaperResults& results, const char* name, const char* title, const CountOf& count) {
  Figure figure{name, title, "step", "collisions", false, false, false, truths_of(results)};
  for (const RowResult& row : results.rows) figure.series.push_back(series_of(row, title_of(row), count));
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

Figure times_figure(const PaperResults& results) {
  Figure figure{"times", "Time of each step, one thread", "step", "ms", false, true, true, {}};
  for (const SettingTime& time : results.times) {
    if (time.detail != ContactDetail::regions) continue;
    Series series{format("%s, %g", time.name.c_str(), time.contact_distance)};
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
