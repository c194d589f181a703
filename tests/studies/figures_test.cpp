// Figures of `graze_studies`: texts that do not overlap, running medians, and which lines are drawn.

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "experiment/paper/text/paper_figures.hpp"
#include "figures/figure_layout.hpp"
#include "figures/result_table.hpp"
#include "figures/running_median.hpp"
#include "scenes/random.hpp"
#include "support/catch.hpp"

using namespace graze::tools;  // NOLINT: the vocabulary of these tests
using graze::scenes::Random;

namespace {

constexpr Canvas canvas{760, 520, 12};

double drawn_from(Random& random, double high) {
  return high * static_cast<double>(random.below(1000)) / 1000;
}

Series random_series(Random& random, std::size_t points, bool labelled) {
  Series series{"series " + std::to_string(random.below(1000))};
  for (std::size_t i = 0; i < points; ++i) {
    const double y = drawn_from(random, 5);
    series.add(static_cast<double>(i + 1), y);
    if (labelled) series.labels.push_back("setting " + std::to_string(i));
  }
  return series;
}

void check_apart(const std::vector<PlacedText>& texts) {
  for (std::size_t i = 0; i < texts.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) CHECK(!texts[i].box.overlaps(texts[k].box));
}

PaperResults results_with_times(std::size_t steps) {
  PaperResults results;
  for (const PaperRow& row : paper_rows(1)) {
    results.rows.push_back({row, Reading::pair, std::vector<StepCount>(steps)});
    results.times.push_back({row.name, graze::ContactDetail::regions, row.last(), {}});
  }
  results.formula.row.name = "eq. 3 and 6";
  results.times.push_back({"eq. 3 and 6", graze::ContactDetail::regions, 8, {}});
  for (const double distance : {8.0, 10.0})
    results.times.push_back({"exact", graze::ContactDetail::regions, distance, {}});
  for (const char* name : {"exact, all distances", "within(0.5), all distances", "within(5), all distances"})
    results.times.push_back({name, graze::ContactDetail::regions, 10, {}});
  for (std::size_t i = 0; i < results.times.size(); ++i)
    for (std::size_t step = 0; step < steps; ++step)
      results.times[i].step_ms.push_back(static_cast<double>((i + 1) * (step % 5 + 1)));
  return results;
}

}  // namespace

TEST_CASE("figures: labels of points cover no other label, no mark and no border of the plot") {
  Random random(11);
  std::size_t placed = 0;
  for (int round = 0; round < 30; ++round) {
    Figure figure{"f", "t", "x", "y", round % 2 == 0, round % 3 == 0, false, {}};
    figure.series = {random_series(random, 10, true), random_series(random, 20, false)};
    figure.series[1].joined = false;
    const FigureLayout layout = layout_of(shown_figure(figure), canvas);
    check_apart(layout.labels);
    placed += layout.labels.size();
    for (const PlacedText& label : layout.labels) {
      CHECK(label.box.left >= layout.plot.left);
      CHECK(label.box.right <= layout.plot.right);
      for (const Series& series : figure.series)
        for (std::size_t i = 0; i < series.x.size(); ++i) {
          const double x =
              layout.plot.left + layout.x.part(series.x[i]) * (layout.plot.right - layout.plot.left);
          const double y =
              layout.plot.low + layout.y.part(series.y[i]) * (layout.plot.high - layout.plot.low);
          CHECK(!label.box.overlaps({x - 1, y - 1, x + 1, y + 1}));
        }
    }
  }
  CHECK(placed > 60);
}

TEST_CASE("figures: names at the ends of lines stand apart, in the order of the ends, right of the plot") {
  Random random(12);
  for (int round = 0; round < 30; ++round) {
    Figure figure{"f", "t", "x", "y", false, false, false, {}};
    figure.named_at_ends = true;
    for (int i = 0; i < 7; ++i) {
      figure.series.push_back(random_series(random, 50, false));
      if (round % 2 == 0) figure.series.back().y.back() = 4.9;  // all end at one place, near the top
    }
    const FigureLayout layout = layout_of(shown_figure(figure), canvas);
    REQUIRE(layout.names.size() == 7);
    check_apart(layout.names);
    for (const PlacedText& name : layout.names) {
      CHECK(name.text == figure.series[name.series].name);
      CHECK(name.box.left > layout.plot.right);
      CHECK(name.box.right <= canvas.width);
      CHECK(name.box.low >= layout.plot.low - 1e-9);
      CHECK(name.box.high <= layout.plot.high + 1e-9);
      for (const PlacedText& other : layout.names)
        if (name.from_y < other.from_y) CHECK(name.box.low < other.box.low);
    }
  }
}

TEST_CASE("figures: a running median is the middle of the sorted values around each") {
  Random random(13);
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) values.push_back(drawn_from(random, 9));
  for (const std::size_t count : {1U, 5U, 9U}) {
    const std::vector<double> medians = running_median(values, count);
    REQUIRE(medians.size() == values.size());
    for (std::size_t i = count / 2; i + count / 2 < values.size(); ++i) {
      const auto smaller = std::count_if(values.begin() + static_cast<std::ptrdiff_t>(i - count / 2),
                                         values.begin() + static_cast<std::ptrdiff_t>(i + count / 2 + 1),
                                         [&](double value) { return value <= medians[i]; });
      CHECK(smaller >= static_cast<std::ptrdiff_t>(count / 2 + 1));
      CHECK(std::ranges::find(values, medians[i]) != values.end());
    }
  }
  CHECK(running_median(std::vector<double>{1, 100, 3}, 3) == std::vector<double>{50.5, 3, 51.5});
  CHECK(running_median(std::vector<double>{}, 3).empty());
}

TEST_CASE("figures: a short logarithmic axis has ticks at 1, 2 and 5 times powers of 10") {
  Figure figure{"f", "t", "x", "y", false, true, false, {{"s", {1, 2}, {400000, 3000000}}}};
  CHECK(Axis(figure, 'y').ticks() == std::vector<double>{500000, 1000000, 2000000});
  figure.series[0].y[0] = 1;
  CHECK(Axis(figure, 'y').ticks().empty());
}

TEST_CASE("figures: the times of an experiment are drawn as four lines of four looks, and the CSV has all") {
  const std::vector<Figure> figures = figures_of(results_with_times(60), "", "");
  REQUIRE(figures.size() == 3);
  const Figure& times = figures.back();
  CHECK(times.series.size() == 11);
  for (const Series& series : times.series)
    CHECK(csv_of(times).find(series.name.find(',') == std::string::npos
                                 ? "\n" + series.name + ","
                                 : "\n\"" + series.name + "\",") != std::string::npos);
  const Figure shown = shown_figure(times);
  std::set<std::size_t> looks;
  std::set<std::string> lines;
  for (const Series& series : shown.series) {
    looks.insert(*series.look);
    if (series.light) continue;
    lines.insert(series.name);
    CHECK(series.y == running_median(std::ranges::find(times.series, series.name, &Series::name)->y, 5));
  }
  CHECK(lines ==
        std::set<std::string>{"row 3 at 8", "eq. 3 and 6 at 8", "exact at 8", "exact, all distances at 10"});
  CHECK(looks.size() == 4);
  CHECK(shown.series.size() == 8);  // the points of each line, too
  for (const Figure& figure : figures) {
    CHECK(figure.named_at_ends);
    CHECK(layout_of(shown_figure(figure), canvas).plot.right > 0.5 * canvas.width);
  }
}
