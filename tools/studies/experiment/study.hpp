#pragma once

#include <string>
#include <vector>

#include "figures/figure.hpp"
#include "figures/result_table.hpp"

namespace graze::tools {

/// A statement of the paper, the measurement beside it, and whether it holds.
struct Claim {
  std::string said;
  std::string measured;
  std::string holds;  ///< "yes", "no", or in what sense
};

/// All that one question brought to light.
struct Study {
  std::string name;  ///< as in a file's name
  std::string title;
  std::string text;  ///< paragraphs of Markdown: what was done and what it shows
  std::vector<ResultTable> tables;
  std::vector<Figure> figures;
  std::vector<Claim> claims;
  /// Requirements that do not hold, one sentence each. With any of them the command fails once everything is
  /// written.
  std::vector<std::string> violations;
};

}  // namespace graze::tools
