#include "figures/figure_plot.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <graze/io/error.hpp>
#include <string>
#include <vector>

#include "figures/figure_layout.hpp"
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

std::string set_axis(const Axis& axis, const std::string& title) {
  const char letter = axis.letter();
  std::string text = format("set %clabel ", letter) + quoted(title) + "\n";
  text += format("%s logscale %c\nset format %c '%%.12g'\n", axis.is_log() ? "set" : "unset", letter, letter);
  std::string ticks;
  for (const double tick : axis.ticks()) ticks += format("%s%.9g", ticks.empty() ? "" : ", ", tick);
  text += format("set %ctics ", letter) + (ticks.empty() ? "auto" : "(" + ticks + ")") + "\n";
  if (axis.has_zero()) text += format("set %ctics add ('0' %.9g)\n", letter, axis.zero());
  return text + format("set %crange [%.9g:%.9g]\n", letter, axis.first(), axis.last());
}

std::string data_of(const Series& series, std::size_t index, const Axis& x, const Axis& y) {
  std::string text = format("$series%zu << EOD\n", index);
  for (std::size_t i = 0; i < series.x.size(); ++i)
    text += format("%.9g %.9g\n", x.place(series.x[i]), y.place(series.y[i]));
  return text + "EOD\n";
}

/// The colour, or a light tone of it: most of it white.
std::string colour_of(const Series& series) {
  const std::string colour = colours[*series.look % colours.size()];
  if (!series.light) return colour;
  std::string light = "#";
  for (const std::size_t part : {1U, 3U, 5U})
    light += format("%02x", (std::stoi(colour.substr(part, 2), nullptr, 16) + 2 * 255) / 3);
  return light;
}

std::string dashes_of(const Series& series) {
  return format(" dashtype %zu linewidth 1.8", *series.look / colours.size() + 1);
}

std::string style_of(const Series& series) {
  const std::string colour = " linecolor rgb '" + colour_of(series) + "'";
  if (series.light) return "with points pointtype 7 pointsize 0.3" + colour;
  const std::size_t turn = *series.look / colours.size();
  const std::string marks =
      format(" pointtype %d pointsize 1.1", point_types[(*series.look + turn) % point_types.size()]);
  if (!series.joined) return "with points" + colour + marks;
  if (!series.marked || series.x.size() > most_marks) return "with lines" + colour + dashes_of(series);
  return "with linespoints" + colour + marks + dashes_of(series);
}

/// One of the figures of a drawing. The whole image is 1 wide and 1 high for gnuplot.
struct Panel {
  double left;  ///< in pixels
  double image_width;
  Canvas canvas;

  [[nodiscard]] std::string at(double x, double y) const {
    return format("screen %.6f, screen %.6f", (left + x) / image_width, y / canvas.height);
  }
  /// The plot's place, and that of the names in two columns below it.
  [[nodiscard]] std::string frame(const PixelBox& plot, std::size_t rows) const {
    std::string text = "set grid linetype 1 linecolor rgb '#e6e6e6'\n";
    text += format("set lmargin at screen %.6f\nset rmargin at screen %.6f\n",
                   (left + plot.left) / image_width, (left + plot.right) / image_width);
    text += format("set bmargin at screen %.6f\nset tmargin at screen %.6f\n", plot.low / canvas.height,
                   plot.high / canvas.height);
    if (rows == 0) return text + "unset key\n";
    return text + "set key at " + at(0.08 * canvas.width, 0.015 * canvas.height) +
           format(" left bottom Left reverse maxrows %zu samplen 2 width 2\n", rows);
  }
};

std::string text_at(const PlacedText& placed, const Panel& panel) {
  return "set label " + quoted(placed.text) + " at " +
         panel.at(placed.box.left, (placed.box.low + placed.box.high) / 2) + " left front\n";
}

/// A line's name, and a thin line from there to its end.
std::string name_at(const PlacedText& name, const Series& series, const Panel& panel) {
  return text_at(name, panel) + "set arrow from " + panel.at(name.from_x, name.from_y) + " to " +
         panel.at(name.box.left - 4, (name.box.low + name.box.high) / 2) + " nohead linecolor rgb '" +
         colour_of(series) + "'\n";
}

std::string plot_of(const Figure& shown, const Panel& panel) {
  const FigureLayout layout = layout_of(shown, panel.canvas);
  std::string text = panel.frame(layout.plot, name_rows(shown)) + "set title " + quoted(shown.title) + "\n" +
                     set_axis(layout.x, shown.x_title) + set_axis(layout.y, shown.y_title);
  for (const PlacedText& label : layout.labels) text += text_at(label, panel);
  for (const PlacedText& name : layout.names) text += name_at(name, shown.series[name.series], panel);
  std::string plots;
  for (std::size_t i = 0; i < shown.series.size(); ++i) {
    const Series& series = shown.series[i];
    text += data_of(series, i, layout.x, layout.y);
    plots += (plots.empty() ? "plot " : ", ") + format("$series%zu using 1:2 ", i) + style_of(series) +
             (series.light ? " notitle" : " title " + quoted(series.name));
  }
  return plots.empty() ? "" : text + plots + "\n";
}

bool is_svg(const Drawing& drawing) {
  return drawing.path.extension() == ".svg";
}

/// gnuplot takes a PNG's font in points.
Canvas canvas_of(const Drawing& drawing) {
  return is_svg(drawing) ? Canvas{900, 600, 13} : Canvas{760, 520, 12};
}

std::string terminal_of(const Drawing& drawing) {
  const Canvas canvas = canvas_of(drawing);
  const std::string size =
      format("%g,%g", canvas.width * static_cast<double>(drawing.panels.size()), canvas.height);
  if (is_svg(drawing))
    return "set terminal svg noenhanced size " + size + " font 'DejaVu Sans,13' background rgb 'white'\n";
  return "set terminal pngcairo noenhanced size " + size + " font 'DejaVu Sans,9'\n";
}

std::string script_of(const Drawing& drawing) {
  const std::size_t panels = drawing.panels.size();
  const Canvas canvas = canvas_of(drawing);
  std::string script = terminal_of(drawing) + "set output " + quoted(drawing.path.string()) + "\n";
  if (panels > 1) script += "set multiplot\n";
  for (std::size_t i = 0; i < panels; ++i) {
    const double left = static_cast<double>(i) * canvas.width;
    script +=
        plot_of(shown_figure(drawing.panels[i]), {left, static_cast<double>(panels) * canvas.width, canvas});
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
