#pragma once

#include <string>
#include <vector>

namespace graze::tools {

struct Series {
  std::string name;
  std::vector<double> x, y;         ///< of one length
  bool joined = true;               ///< a line through the points, otherwise points alone
  std::vector<std::string> labels;  ///< none, or one a point, written beside it where there is room
  bool marked = true;               ///< a mark at each point, where they are few
};

/// Times or counts against each other; see figure_plot.hpp.
struct Figure {
  std::string name;  ///< as in a file's name
  std::string title;
  std::string x_title, y_title;
  bool log_x = false, log_y = false;
  bool timed = false;
  std::vector<Series> series;
};

}  // namespace graze::tools
