#include "accuracy/plot.hpp"

#include <array>
#include <graze/io/scene_file.hpp>
#include <string>
#include <utility>

#include "figures/figure_plot.hpp"

namespace graze::tools {
namespace {

/// The families that are drawn, without `paper_loose`, whose error is of another kind.
constexpr std::array<ModeFamily, 6> drawn_families = {ModeFamily::exact,         ModeFamily::within,
                                                      ModeFamily::work_budget,   ModeFamily::time_budget,
                                                      ModeFamily::paper_formula, ModeFamily::paper_numbers};

/// Gives the value of one result on the y axis.
using ErrorOf = double (*)(const ModeResult&);

/// A family has one colour in both figures. Settings of vertices have other dashes.
void add_series(Figure& figure, const ModeTable& table, ErrorOf error) {
  for (std::size_t i = 0; i < drawn_families.size(); ++i) {
    Series series{title_of(drawn_families[i]) + ": " + std::string(to_string(table.detail))};
    series.look = i + (table.detail == ContactDetail::vertices ? colour_count : 0);
    for (const auto* results : {&table.results, &table.timed})
      for (const ModeResult& result : *results)
        if (result.setting.family == drawn_families[i]) series.add(result.step_ms, error(result));
    if (!series.x.empty()) figure.series.push_back(std::move(series));
  }
}

/// Shows a detail of surfaces and the detail `vertices`.
Figure figure_of(std::span<const ModeTable> tables, ContactDetail detail, const char* title,
                 const char* y_title, ErrorOf error) {
  Figure figure{"", title, "time a step (ms, one thread)", y_title, true, true, true, {}};
  for (const ModeTable& table : tables)
    if (table.detail == detail || table.detail == ContactDetail::vertices) add_series(figure, table, error);
  return figure;
}

}  // namespace

void plot_time_against_error(const std::filesystem::path& path, std::span<const ModeTable> tables) {
  const std::array<Figure, 2> figures = {
      figure_of(tables, ContactDetail::none, "How wide the bounds of distances are",
                "upper − lower, mean over pairs (edge lengths)",
                [](const ModeResult& result) { return result.width.mean(); }),
      figure_of(tables, ContactDetail::features, "How many contacts are missing",
                "share of the true contacts that are not reported",
                [](const ModeResult& result) { return 1 - result.recall(); })};
  const Drawing drawing{figures, path};
  draw({&drawing, 1});
}

}  // namespace graze::tools
