#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace graze::tools {

/// How many colours there are. A look that is so much higher has the colour again, with other dashes.
inline constexpr std::size_t colour_count = 8;

struct Series {
  std::string name;
  std::vector<double> x = {}, y = {};    ///< of one length
  bool joined = true;                    ///< a line through the points, otherwise points alone
  std::vector<std::string> labels = {};  ///< none, or one a point, written beside it where there is room
  bool marked = true;                    ///< a mark at each point, where they are few
  std::optional<std::size_t> look = {};  ///< which of the looks it has, by default that of its index
  bool drawn = true;                     ///< false: only in the CSV of the figure
  bool light = false;                    ///< small points in a light tone, without a name

  void add(double at_x, double at_y) {
    x.push_back(at_x);
    y.push_back(at_y);
  }
};

/// Times or counts against each other, see figure_plot.hpp.
struct Figure {
  std::string name;  ///< as in a file's name
  std::string title;
  std::string x_title, y_title;
  bool log_x = false, log_y = false;
  bool timed = false;
  std::vector<Series> series;
  /// Above 1, each line is the running median over so many points, and the points are drawn in a light tone.
  std::size_t median_of = 0;
  /// The name of each series stands beside the end of its line, otherwise all names stand below the plot.
  bool named_at_ends = false;
};

}  // namespace graze::tools
