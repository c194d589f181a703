#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace graze::tools {

enum class Align : std::uint8_t { right, left };

/// A column of a table of texts.
struct TextColumn {
  std::string title;
  std::size_t width = 0;       ///< shorter cells are filled up, so that the table can be read on a terminal
  Align align = Align::right;  ///< as numbers are
};

/// A table in Markdown, made a line at a time.
class TextTable {
 public:
  explicit TextTable(std::vector<TextColumn> columns) : columns_(std::move(columns)) {}
  /// Text in the first column, numbers in the others. With widths no column is narrower than its title.
  static TextTable of_numbers(const std::vector<std::string>& titles, std::size_t first_width = 0,
                              std::size_t width = 0);

  /// The titles and the rule below them.
  [[nodiscard]] std::string head() const;
  /// A row, which may have fewer cells than there are columns.
  [[nodiscard]] std::string row(const std::vector<std::string>& cells) const;

 private:
  std::vector<TextColumn> columns_;
};

/// A text as Markdown shows it in a cell: on one line, with no bar that would end the cell and nothing that
/// would begin a tag.
std::string markdown_text(const std::string& text);

}  // namespace graze::tools
