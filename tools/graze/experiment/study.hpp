#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "figure.hpp"

namespace graze::tools {

struct Column {
  std::string name;  ///< as in the CSV: lower case, words joined by _
  std::string title;
};

/// Text, a number, or a count.
using Cell = std::variant<std::string, double, std::uint64_t>;

/// Written as a CSV file of its name, and as a table of the page and the document where it is `shown`.
struct ResultTable {
  std::string name;  ///< as in a file's name
  std::string title;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
  bool timed = false;                   ///< holds times: not the same in a second run
  bool shown = true;                    ///< false: too long to read, data of a figure
};

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
