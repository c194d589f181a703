#include "figures/figure_layout.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "figures/running_median.hpp"

namespace graze::tools {
namespace {

/// The number of characters: bytes of UTF-8 that begin one.
std::size_t length_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

/// Somewhat wider than DejaVu Sans writes it.
double width_of(const std::string& text, double font) {
  return 0.6 * font * static_cast<double>(length_of(text));
}

struct Pixel {
  double x, y;
};

Pixel pixel_of(const FigureLayout& layout, double x, double y) {
  const PixelBox& plot = layout.plot;
  return {plot.left + layout.x.part(x) * (plot.right - plot.left),
          plot.low + layout.y.part(y) * (plot.high - plot.low)};
}

PixelBox plot_of(const Figure& figure, const Canvas& canvas) {
  double names_width = 0;
  if (figure.named_at_ends)
    for (const Series& series : figure.series)
      names_width = std::max(names_width, width_of(series.name, canvas.font) + 2 * canvas.font);
  const double names_height = 1.25 * canvas.font * static_cast<double>(name_rows(figure));
  return {8 * canvas.font, names_height + 5 * canvas.font, canvas.width - names_width - 1.5 * canvas.font,
          canvas.height - 3 * canvas.font};
}

/// Whether a stretch goes through a box, by cutting it at the box's four sides.
bool goes_through(const PixelBox& box, const Pixel& from, const Pixel& to) {
  double enter = 0;
  double leave = 1;
  const auto cut = [&](double start, double step, double low, double high) {
    if (step == 0) return start >= low && start <= high;
    const double at_low = (low - start) / step;
    const double at_high = (high - start) / step;
    enter = std::max(enter, std::min(at_low, at_high));
    leave = std::min(leave, std::max(at_low, at_high));
    return enter <= leave;
  };
  return cut(from.x, to.x - from.x, box.left, box.right) && cut(from.y, to.y - from.y, box.low, box.high);
}

/// Places labels beside their points, so that they cover no label, mark or line.
class LabelRoom {
 public:
  LabelRoom(const Figure& figure, const FigureLayout& layout, double font)
      : layout_(layout), font_(font), lines_(figure.series.size()) {
    for (std::size_t i = 0; i < figure.series.size(); ++i) add(figure.series[i], lines_[i]);
  }

  /// Later points first: on a Pareto front they have the smaller error.
  void place(const Series& series, std::size_t index, std::vector<PlacedText>& placed) {
    for (std::size_t i = series.labels.size(); i-- > 0;) {
      if (series.labels[i].empty()) continue;
      const Pixel point = pixel_of(layout_, series.x[i], series.y[i]);
      for (const PixelBox& box : boxes_beside(point, width_of(series.labels[i], font_))) {
        if (!is_free(box)) continue;
        taken_.push_back(box);
        placed.push_back({series.labels[i], box, index, point.x, point.y});
        break;
      }
    }
  }

 private:
  void add(const Series& series, std::vector<Pixel>& line) {
    const double radius = 0.4 * font_;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const Pixel point = pixel_of(layout_, series.x[i], series.y[i]);
      taken_.push_back({point.x - radius, point.y - radius, point.x + radius, point.y + radius});
      if (series.joined) line.push_back(point);
    }
  }

  /// Right of the point first, then left of it: level with it, above and below.
  [[nodiscard]] std::array<PixelBox, 6> boxes_beside(const Pixel& point, double width) const {
    const double gap = 0.7 * font_;
    std::array<PixelBox, 6> boxes{};
    std::size_t next = 0;
    for (const double left : {point.x + gap, point.x - gap - width})
      for (const double middle : {point.y, point.y + font_, point.y - font_})
        boxes[next++] = {left, middle - 0.6 * font_, left + width, middle + 0.6 * font_};
    return boxes;
  }

  [[nodiscard]] bool is_free(const PixelBox& box) const {
    const PixelBox& plot = layout_.plot;
    if (box.left < plot.left || box.right > plot.right || box.low < plot.low || box.high > plot.high)
      return false;
    if (std::ranges::any_of(taken_, [&](const PixelBox& other) { return box.overlaps(other); })) return false;
    return std::ranges::none_of(lines_, [&](const std::vector<Pixel>& line) {
      for (std::size_t i = 1; i < line.size(); ++i)
        if (goes_through(box, line[i - 1], line[i])) return true;
      return false;
    });
  }

  const FigureLayout& layout_;
  double font_;
  std::vector<PixelBox> taken_;
  std::vector<std::vector<Pixel>> lines_;  ///< one a series
};

/// Moves heights apart, from the lowest to the highest, as far as they have to be and stay above `low`.
std::vector<double> moved_apart(std::vector<double> heights, double gap, double low, double high) {
  std::vector<std::size_t> order(heights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return heights[i]; });
  double free_from = low;
  for (const std::size_t i : order) {
    heights[i] = std::max(heights[i], free_from);
    free_from = heights[i] + gap;
  }
  double free_to = high;
  for (std::size_t k = order.size(); k-- > 0; free_to = heights[order[k]] - gap)
    heights[order[k]] = std::min(heights[order[k]], free_to);
  return heights;
}

void place_names(const Figure& figure, double font, FigureLayout& layout) {
  std::vector<PlacedText> names;
  std::vector<double> heights;
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    const Series& series = figure.series[i];
    if (series.light) continue;
    const Pixel end = pixel_of(layout, series.x.back(), series.y.back());
    names.push_back({series.name, {}, i, end.x, end.y});
    heights.push_back(end.y);
  }
  const double half = 0.6 * font;
  heights = moved_apart(heights, 1.25 * font, layout.plot.low + half, layout.plot.high - half);
  const double left = layout.plot.right + 2 * font;
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i].box = {left, heights[i] - half, left + width_of(names[i].text, font), heights[i] + half};
  layout.names = std::move(names);
}

}  // namespace

Figure shown_figure(const Figure& figure) {
  Figure shown = figure;
  shown.series.clear();
  for (const Series& series : figure.series) {
    if (!series.drawn || series.x.empty()) continue;
    shown.series.push_back(series);
    Series& line = shown.series.back();
    if (!line.look) line.look = shown.series.size() - 1;
  }
  if (figure.median_of < 2) return shown;
  std::vector<Series> points = shown.series;
  for (Series& each : points) {
    each.light = true;
    each.joined = false;
  }
  for (Series& line : shown.series) line.y = running_median(line.y, figure.median_of);
  shown.series.insert(shown.series.begin(), points.begin(), points.end());
  return shown;
}

std::size_t name_rows(const Figure& shown) {
  if (shown.named_at_ends) return 0;
  const auto names = std::ranges::count_if(shown.series, [](const Series& series) { return !series.light; });
  return static_cast<std::size_t>(names + 1) / 2;
}

FigureLayout layout_of(const Figure& shown, const Canvas& canvas) {
  FigureLayout layout{Axis(shown, 'x'), Axis(shown, 'y'), plot_of(shown, canvas), {}, {}};
  if (shown.named_at_ends) place_names(shown, canvas.font, layout);
  LabelRoom room(shown, layout, canvas.font);
  for (std::size_t i = 0; i < shown.series.size(); ++i) room.place(shown.series[i], i, layout.labels);
  return layout;
}

}  // namespace graze::tools
