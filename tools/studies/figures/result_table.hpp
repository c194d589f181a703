#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "figures/figure.hpp"

namespace graze::tools {

struct Column {
  std::string name;  ///< as in the CSV: lower case, words joined by _
  std::string title;
};

/// Makes columns of texts such as "steps" and "mean_ms: mean of all steps". A column without a title has its
/// name as the title, with a space for each _.
std::vector<Column> columns_of(const std::vector<std::string>& texts);

/// Text, a number, or a count.
using Cell = std::variant<std::string, double, std::uint64_t>;

/// A table that is written as CSV and as Markdown.
struct ResultTable {
  std::string name;  ///< as in a file's name
  std::string title;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows = {};  ///< each as long as `columns`
  bool timed = false;                        ///< holds times: not the same in a second run
  bool shown = true;                         ///< false: too long to read, data of a figure
};

/// RFC 4180, but for lines that end in \n. Numbers are the shortest that read back as the same double.
std::string csv_of(const ResultTable& table);
/// A row for each point: series, x, y, label.
std::string csv_of(const Figure& figure);

/// The title and the table.
std::string markdown_of(const ResultTable& table);

}  // namespace graze::tools
