#include "experiment/figure_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "gnuplot.hpp"
#include "text_format.hpp"

namespace graze::tools {
namespace {

/// Of Okabe and Ito, which the colour-blind can tell apart; yellow is left out, which white swallows.
constexpr std::array<const char*, 7> colours = {"#000000", "#0072b2", "#d55e00", "#009e73",
                                                "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array<int, 7> point_types = {7, 5, 9, 11, 13, 4, 6};
/// Lines of more points than this have no marks on them.
constexpr std::size_t most_marks = 40;

/// An axis, and where 0 is drawn on it.
struct Axis {
  char letter = 'x';
  bool is_log = false;
  double low = std::numeric_limits<double>::infinity();  ///< positive, or finite if not log
  double high = -std::numeric_limits<double>::infinity();
  bool has_zero = false;

  void add(double value) {
    if (is_log && value <= 0) {
      has_zero = true;
    } else if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  [[nodiscard]] double zero() const {
    return std::isfinite(low) ? std::pow(10, std::floor(std::log10(low) + 1e-9) - 1) : 1e-3;
  }
  [[nodiscard]] double place(double value) const { return is_log && value <= 0 ? zero() : value; }
};

Axis axis_of(const Figure& figure, char letter, bool is_log) {
  Axis axis;
  axis.letter = letter;
  axis.is_log = is_log;
  for (const Series& series : figure.series)
    for (const double value : letter == 'x' ? series.x : series.y) axis.add(value);
  return axis;
}

std::string set_axis(const Axis& axis, const std::string& title) {
  std::string text = format("set %clabel ", axis.letter) + gnuplot_quoted(title) + "\n";
  text += format("set autoscale %c\nset %ctics auto\nset format %c '%%g'\n", axis.letter, axis.letter,
                 axis.letter);
  if (!axis.is_log) {
    text += format("unset logscale %c\n", axis.letter);
    if (axis.low >= 0 && axis.low < 0.5 * axis.high) text += format("set %crange [0:*]\n", axis.letter);
    return text;
  }
  text += format("set logscale %c\n", axis.letter);
  const double top = std::isfinite(axis.high) ? axis.high : 10 * axis.zero();
  const double bottom = axis.has_zero ? axis.zero() : axis.low;
  if (axis.has_zero) text += format("set %ctics add ('0' %.9g)\n", axis.letter, axis.zero());
  return text + format("set %crange [%.9g:%.9g]\n", axis.letter, bottom / 1.6, top * 1.6);
}

std::string data_of(const Series& series, std::size_t index, const Axis& x, const Axis& y) {
  std::string text = format("$series%zu << EOD\n", index);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    text += format("%.9g %.9g", x.place(series.x[i]), y.place(series.y[i]));
    if (!series.labels.empty()) {
      std::string label = series.labels[i];
      std::replace(label.begin(), label.end(), '"', '\'');
      text += " \"" + label + "\"";
    }
    text += "\n";
  }
  return text + "EOD\n";
}

std::string style_of(const Series& series, std::size_t index) {
  const std::size_t turn = index / colours.size();
  const std::string colour = std::string(" linecolor rgb '") + colours[index % colours.size()] + "'";
  const std::string marks =
      format(" pointtype %d pointsize 0.9", point_types[(index + turn) % point_types.size()]);
  if (!series.joined) return "with points" + colour + marks;
  const std::string dashes = format(" dashtype %zu linewidth 1.6", turn + 1);
  if (series.x.size() > most_marks) return "with lines" + colour + dashes;
  return "with linespoints" + colour + marks + dashes;
}

std::string plot_of(const Figure& figure) {
  const Axis x = axis_of(figure, 'x', figure.log_x);
  const Axis y = axis_of(figure, 'y', figure.log_y);
  std::string text = "set title " + gnuplot_quoted(figure.title) + "\n" + set_axis(x, figure.x_title) +
                     set_axis(y, figure.y_title);
  std::string plots;
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    const Series& series = figure.series[i];
    if (series.x.empty()) continue;
    text += data_of(series, i, x, y);
    plots += (plots.empty() ? "plot " : ", ") + format("$series%zu using 1:2 ", i) + style_of(series, i) +
             " title " + gnuplot_quoted(series.name);
    if (!series.labels.empty())
      plots += format(", $series%zu using 1:2:3 with labels left offset 0.6,0.5 font ',8' notitle", i);
  }
  return plots.empty() ? "" : text + plots + "\n";
}

std::string terminal_of(const std::filesystem::path& path) {
  if (path.extension() == ".svg")
    return "set terminal svg noenhanced size 900,600 font 'DejaVu Sans,13' background rgb 'white'\n";
  return "set terminal pngcairo noenhanced size 900,600 font 'DejaVu Sans,10'\n";
}

}  // namespace

void draw(std::span<const Drawing> drawings) {
  std::string script;
  for (const Drawing& drawing : drawings)
    script += terminal_of(drawing.path) + "set output " + gnuplot_quoted(drawing.path.string()) +
              "\nset grid linecolor rgb '#dddddd'\nset key below left maxrows 4 samplen 2\n" +
              plot_of(*drawing.figure) + "unset output\nreset\n";
  if (!drawings.empty()) run_gnuplot(script, drawings.front().path.parent_path().string());
}

}  // namespace graze::tools
