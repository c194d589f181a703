#include "output/text_table.hpp"

#include <algorithm>

namespace graze::tools {
namespace {

/// How many letters a text in UTF-8 has.
std::size_t length_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

}  // namespace

TextTable TextTable::of_numbers(const std::vector<std::string>& titles, std::size_t first_width,
                                std::size_t width) {
  std::vector<TextColumn> columns = {{titles.front(), first_width, Align::left}};
  for (std::size_t i = 1; i < titles.size(); ++i)
    columns.push_back({titles[i], width == 0 ? 0 : std::max(width, length_of(titles[i]))});
  return TextTable(std::move(columns));
}

std::string TextTable::head() const {
  std::vector<std::string> titles, rules;
  for (const TextColumn& column : columns_) {
    const std::string dashes(std::max<std::size_t>(column.width, 3) - 1, '-');
    titles.push_back(column.title);
    rules.push_back(column.align == Align::left ? ":" + dashes : dashes + ":");
  }
  return row(titles) + row(rules);
}

std::string TextTable::row(const std::vector<std::string>& cells) const {
  std::string line = "|";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string text = markdown_text(cells[i]);
    const std::size_t length = length_of(text);
    const std::string gap(columns_[i].width - std::min(length, columns_[i].width), ' ');
    line += columns_[i].align == Align::left ? " " + text + gap + " |" : " " + gap + text + " |";
  }
  return line + "\n";
}

std::string markdown_text(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '|') {
      result += "\\|";
    } else if (letter == '<') {
      result += "&lt;";
    } else {
      result += letter == '\n' ? ' ' : letter;
    }
  }
  return result;
}

}  // namespace graze::tools
