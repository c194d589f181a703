#include "accuracy/plot.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "gnuplot.hpp"
#include "text_format.hpp"

namespace graze::tools {
namespace {

/// The share at which the plot draws a share of missing contacts that is 0.
constexpr double none_missing = 1e-6;
/// The narrowest width that the axis shows.
constexpr double narrowest = 1e-17;

struct Point {
  double ms, error;
};

/// Points that one line joins, in the style of gnuplot.
struct Line {
  std::string title;
  std::string style;
  std::vector<Point> points;
};

/// Gives the value of one result on the y axis.
using ErrorOf = double (*)(const ModeResult&);

double width_of(const ModeResult& result) {
  return std::max(result.width.mean(), narrowest);
}

double missing_of(const ModeResult& result) {
  return std::max(1 - result.recall(), none_missing);
}

/// How a family is drawn; `paper_loose` is not, whose error is of another kind.
struct FamilyStyle {
  ModeFamily family;
  const char* title;
  const char* colour;
};
constexpr std::array<FamilyStyle, 6> family_styles = {
    {{ModeFamily::exact, "exact", "#000000"},
     {ModeFamily::within, "within(t)", "#009e73"},
     {ModeFamily::work_budget, "work budget", "#0072b2"},
     {ModeFamily::time_budget, "time budget", "#e69f00"},
     {ModeFamily::paper_formula, "paper, eq. 3 and 6", "#cc79a7"},
     {ModeFamily::paper_numbers, "paper, numbers", "#d62728"}}};

struct DetailStyle {
  const char* title;
  const char* points;
};

DetailStyle style_of(ContactDetail detail) {
  switch (detail) {
    case ContactDetail::none:
      return {"none", "pointtype 7 dashtype 1"};
    case ContactDetail::features:
      return {"features", "pointtype 5 dashtype 1"};
    default:
      return {"vertices", "pointtype 9 dashtype 2"};
  }
}

void add_lines(std::vector<Line>& lines, const ModeTable& table, ErrorOf error) {
  const DetailStyle detail = style_of(table.detail);
  for (const FamilyStyle& style : family_styles) {
    Line line{std::string(style.title) + ": " + detail.title,
              std::string("linecolor rgb '") + style.colour + "' " + detail.points,
              {}};
    for (const auto* results : {&table.results, &table.timed})
      for (const ModeResult& result : *results)
        if (result.setting.family == style.family) line.points.push_back({result.step_ms, error(result)});
    if (!line.points.empty()) lines.push_back(std::move(line));
  }
}

std::string plot_command(const std::vector<Line>& lines, const std::string& block) {
  std::string data, plot;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    data += "$" + block + std::to_string(i) + " << EOD\n";
    for (const Point& point : lines[i].points) data += format("%.9g %.9g\n", point.ms, point.error);
    data += "EOD\n";
    plot += (i == 0 ? "plot $" : ", $") + block + std::to_string(i) +
            " with linespoints linewidth 2 pointsize 1.3 " + lines[i].style + " title " +
            gnuplot_quoted(lines[i].title);
  }
  return data + plot + "\n";
}

std::string script_of(const std::filesystem::path& path, std::span<const ModeTable> tables) {
  std::vector<Line> widths, missing;
  for (const ModeTable& table : tables) {
    if (table.detail == ContactDetail::none || table.detail == ContactDetail::vertices)
      add_lines(widths, table, width_of);
    if (table.detail == ContactDetail::features || table.detail == ContactDetail::vertices)
      add_lines(missing, table, missing_of);
  }
  return "set terminal pngcairo size 1500,780 font 'DejaVu Sans,11'\nset output " +
         gnuplot_quoted(path.string()) +
         "\nset multiplot layout 1,2\nset logscale xy\nset grid\nset bmargin 9\nset key below center maxcols "
         "2 samplen 3\n"
         "set xlabel 'time a step (ms, one thread)'\n"
         "set title 'How wide the bounds of distances are'\n"
         "set ylabel 'upper - lower, mean over pairs (edge lengths)'\nset format y '10^{%T}'\n" +
         plot_command(widths, "width") +
         format(
             "set title 'How many contacts are missing'\n"
             "set ylabel 'share of the true contacts that are not reported'\nset yrange [%g:2]\n"
             "set ytics add ('none' %g)\n",
             none_missing / 2, none_missing) +
         plot_command(missing, "missing") + "unset multiplot\n";
}

}  // namespace

void plot_time_against_error(const std::filesystem::path& path, std::span<const ModeTable> tables) {
  run_gnuplot(script_of(path, tables), path.string());
}

}  // namespace graze::tools
