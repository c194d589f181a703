#pragma once

#include <string>
#include <vector>

#include "figures/axis.hpp"
#include "figures/figure.hpp"

namespace graze::tools {

/// The room for one figure, and the height of its font, in pixels.
struct Canvas {
  double width, height, font;
};

/// In pixels from the lower left corner of the canvas.
struct PixelBox {
  double left, low, right, high;

  [[nodiscard]] bool overlaps(const PixelBox& other) const {
    return left < other.right && other.left < right && low < other.high && other.low < high;
  }
};

/// A text that begins at the left of its box, in the middle of its height.
struct PlacedText {
  std::string text;
  PixelBox box;
  std::size_t series = 0;         ///< whose point or line it names
  double from_x = 0, from_y = 0;  ///< that point, or the end of that line
};

/// The places of a figure's plot and texts. No two texts overlap.
///
///     +--------------------------------------------------+
///     |                      title                       |
///     |        +----------------------------+            |
///     |        |  o label            ______/|--- name    |
///     | y axis |   \________________/_______|--- name    |
///     |        |                    \_______|--- name    |
///     |        +----------------------------+            |
///     |                    x axis                        |
///     |  o name    o name             (or the names here)|
///     +--------------------------------------------------+
struct FigureLayout {
  Axis x, y;
  PixelBox plot;
  std::vector<PlacedText> labels;  ///< of points: those for which there is room
  std::vector<PlacedText> names;   ///< at the ends of lines, where the figure has them there
};

/// The series as they are drawn: those that are, with their looks, and medians behind their points.
Figure shown_figure(const Figure& figure);

/// Places the texts of a figure that `shown_figure` gave.
FigureLayout layout_of(const Figure& shown, const Canvas& canvas);

/// How many rows of names, two in each, stand below the plot.
std::size_t name_rows(const Figure& shown);

}  // namespace graze::tools
