#include "bench/growth_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "figures/figure_plot.hpp"

namespace graze::bench {
namespace {

/// A quantity that grows from scene to scene.
struct Growth {
  char scenes;
  const char* name;
  const char* title;
  std::size_t Run::*count;
};
constexpr std::array<Growth, 2> growths = {{{'G', "objects", "surfaces of 258 vertices", &Run::objects},
                                            {'V', "vertices", "vertices of two spheres", &Run::vertices}}};

tools::Series& series_of(tools::Figure& figure, const std::string& name) {
  const auto found = std::find_if(figure.series.begin(), figure.series.end(),
                                  [&](const tools::Series& series) { return series.name == name; });
  if (found != figure.series.end()) return *found;
  return figure.series.emplace_back(tools::Series{name});
}

tools::Figure figure_of(const Growth& growth, Task task, const std::vector<Run>& runs) {
  const std::string letter(1, static_cast<char>(task));
  tools::Figure figure;
  figure.name = std::string("growth_") + growth.name + "_" + letter;
  figure.title = "Task " + letter + ", one frame against the number of " + growth.title;
  figure.x_title = growth.name;
  figure.y_title = "ms";
  figure.log_x = figure.log_y = figure.timed = true;
  for (const Run& run : runs) {
    if (!run.scene.starts_with(growth.scenes) || run.task != task || run.threads != runs.front().threads)
      continue;
    for (const Timing& timing : run.timings) {
      if (std::isnan(run.median(timing.name))) continue;
      series_of(figure, timing.name).add(static_cast<double>(run.*growth.count), timing.median);
    }
  }
  return figure;
}

}  // namespace

void draw_growth(const std::filesystem::path& folder, const std::vector<Run>& runs) {
  std::vector<tools::Figure> figures;
  for (const Growth& growth : growths)
    for (const Task task : {Task::A, Task::B, Task::D}) {
      tools::Figure figure = figure_of(growth, task, runs);
      if (!figure.series.empty() && figure.series.front().x.size() > 1) figures.push_back(std::move(figure));
    }
  std::vector<tools::Drawing> drawings;
  drawings.reserve(figures.size());
  for (const tools::Figure& figure : figures)
    drawings.push_back({{&figure, 1}, folder / (figure.name + ".png")});
  tools::draw(drawings);
}

}  // namespace graze::bench
