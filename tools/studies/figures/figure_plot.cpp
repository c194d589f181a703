#include "figures/figure_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <graze/io/error.hpp>
#include <limits>
#include <string>
#include <vector>

#include "output/text.hpp"

namespace graze::tools {
namespace {

/// Colours of Okabe and Ito, which the colour-blind can tell apart. Brown is in place of yellow, which is
/// hard to see on white.
constexpr std::array<const char*, colour_count> colours = {"#000000", "#0072b2", "#e69f00", "#cc79a7",
                                                           "#56b4e9", "#8c564b", "#009e73", "#d55e00"};
constexpr std::array<int, 7> point_types = {7, 5, 9, 11, 13, 15, 4};
/// Lines of more points than this have no marks on them.
constexpr std::size_t most_marks = 40;

/// As gnuplot reads it back: in single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) result += letter == '\'' ? std::string("''") : std::string(1, letter);
  return result + "'";
}

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
  /// The first value on the axis. The axis has some room on both sides of the values shown.
  [[nodiscard]] double first() const {
    if (is_log) return bottom() / room();
    return low >= 0 && low < 0.5 * high ? 0 : low - 0.05 * (high - low);
  }
  [[nodiscard]] double last() const {
    if (is_log) return top() * room();
    return high > first() ? high + 0.07 * (high - first()) : first() + 1;
  }
  /// 0 where the axis begins, 1 where it ends.
  [[nodiscard]] double part(double value) const {
    if (is_log) return std::log(place(value) / first()) / std::log(last() / first());
    return (value - first()) / (last() - first());
  }

 private:
  [[nodiscard]] double bottom() const { return has_zero ? zero() : low; }
  [[nodiscard]] double top() const { return std::isfinite(high) ? high : zero(); }
  [[nodiscard]] double room() const { return std::max(1.3, std::pow(top() / bottom(), 0.07)); }
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
  std::string text = format("set %clabel ", axis.letter) + quoted(title) + "\n";
  text += format("%s logscale %c\nset %ctics auto\nset format %c '%%g'\n", axis.is_log ? "set" : "unset",
                 axis.letter, axis.letter, axis.letter);
  if (axis.has_zero) text += format("set %ctics add ('0' %.9g)\n", axis.letter, axis.zero());
  return text + format("set %crange [%.9g:%.9g]\n", axis.letter, axis.first(), axis.last());
}

/// Keeps labels from being written over each other: where a later point's label is, none of an earlier one.
class LabelRoom {
 public:
  LabelRoom(const Axis& x, const Axis& y) : x_(x), y_(y) {}

  bool take(double x, double y, const std::string& label) {
    const Box box{x_.part(x), y_.part(y), x_.part(x) + 0.02 + 0.0075 * static_cast<double>(label.size()),
                  y_.part(y) + 0.04};
    const bool is_free = std::ranges::none_of(taken_, [&](const Box& other) {
      return box.left < other.right && other.left < box.right && box.low < other.high && other.low < box.high;
    });
    if (is_free) taken_.push_back(box);
    return is_free;
  }

 private:
  struct Box {
    double left, low, right, high;
  };
  const Axis& x_;
  const Axis& y_;
  std::vector<Box> taken_;
};

std::string data_of(const Series& series, std::size_t index, const Axis& x, const Axis& y) {
  std::string text = format("$series%zu << EOD\n", index);
  for (std::size_t i = 0; i < series.x.size(); ++i)
    text += format("%.9g %.9g\n", x.place(series.x[i]), y.place(series.y[i]));
  return text + "EOD\n";
}

std::string labels_of(const Series& series, const Axis& x, const Axis& y, LabelRoom& room) {
  std::string text;
  for (std::size_t i = series.labels.size(); i-- > 0;)
    if (!series.labels[i].empty() && room.take(series.x[i], series.y[i], series.labels[i]))
      text += "set label " + quoted(series.labels[i]) +
              format(" at %.9g,%.9g left offset 0.6,0.5 font ',9' front\n", x.place(series.x[i]),
                     y.place(series.y[i]));
  return text;
}

std::string style_of(const Series& series, std::size_t index) {
  const std::size_t look = series.look.value_or(index);
  const std::size_t turn = look / colours.size();
  const std::string colour = std::string(" linecolor rgb '") + colours[look % colours.size()] + "'";
  const std::string marks =
      format(" pointtype %d pointsize 1.1", point_types[(look + turn) % point_types.size()]);
  if (!series.joined) return "with points" + colour + marks;
  const std::string dashes = format(" dashtype %zu linewidth 1.6", turn + 1);
  if (!series.marked || series.x.size() > most_marks) return "with lines" + colour + dashes;
  return "with linespoints" + colour + marks + dashes;
}

std::string plot_of(const Figure& figure) {
  const Axis x = axis_of(figure, 'x', figure.log_x);
  const Axis y = axis_of(figure, 'y', figure.log_y);
  std::string text =
      "set title " + quoted(figure.title) + "\n" + set_axis(x, figure.x_title) + set_axis(y, figure.y_title);
  std::string plots;
  LabelRoom room(x, y);
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    const Series& series = figure.series[i];
    if (series.x.empty()) continue;
    text += data_of(series, i, x, y) + labels_of(series, x, y, room);
    plots += (plots.empty() ? "plot " : ", ") + format("$series%zu using 1:2 ", i) + style_of(series, i) +
             " title " + quoted(series.name);
  }
  return plots.empty() ? "" : text + plots + "\n";
}

std::string terminal_of(const Drawing& drawing) {
  const std::size_t panels = drawing.panels.size();
  if (drawing.path.extension() == ".svg")
    return format("set terminal svg noenhanced size %zu,600 font 'DejaVu Sans,13' background rgb 'white'\n",
                  900 * panels);
  return format("set terminal pngcairo noenhanced size %zu,520 font 'DejaVu Sans,9'\n", 760 * panels);
}

/// The names of the series in two columns below the plot, however long they are. `left` is where the panel
/// begins, and `width` how wide it is. The whole image is 1 wide.
std::string layout_of(const Figure& figure, double left, double width) {
  const std::size_t rows = (figure.series.size() + 1) / 2;
  return "set grid linecolor rgb '#dddddd'\nset lmargin 10\nset rmargin 3\n" +
         format(
             "set bmargin %zu\nset key at screen %g,0.015 left bottom Left reverse maxrows %zu samplen 2 "
             "width 2\n",
             rows + 5, left + 0.08 * width, rows);
}

std::string script_of(const Drawing& drawing) {
  const std::size_t panels = drawing.panels.size();
  std::string script = terminal_of(drawing) + "set output " + quoted(drawing.path.string()) + "\n";
  if (panels > 1) script += format("set multiplot layout 1,%zu\n", panels);
  for (std::size_t i = 0; i < panels; ++i) {
    const double width = 1 / static_cast<double>(panels);
    const double left = static_cast<double>(i) * width;
    script += layout_of(drawing.panels[i], left, width) + plot_of(drawing.panels[i]);
    if (i + 1 < panels) script += "reset\n";
  }
  return script + (panels > 1 ? "unset multiplot\n" : "") + "unset output\nreset\n";
}

}  // namespace

bool has_gnuplot() {
  return std::system("gnuplot --version >/dev/null 2>&1") == 0;
}

void draw(std::span<const Drawing> drawings) {
  if (drawings.empty()) return;
  std::string script;
  for (const Drawing& drawing : drawings) script += script_of(drawing);
  std::FILE* gnuplot = popen("gnuplot", "w");
  const bool written =
      gnuplot != nullptr && std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  const bool drawn = gnuplot != nullptr && pclose(gnuplot) == 0;
  if (!written || !drawn)
    throw io::InputError(drawings.front().path.parent_path().string() +
                         ": gnuplot could not draw this figure; see its message above");
}

}  // namespace graze::tools
