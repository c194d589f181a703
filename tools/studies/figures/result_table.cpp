#include "figures/result_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "output/text.hpp"
#include "output/text_table.hpp"

namespace graze::tools {
namespace {

std::string csv_text(double value) {
  std::array<char, 32> text;
  auto* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string csv_text(std::uint64_t value) {
  return std::to_string(value);
}

std::string csv_text(const std::string& value) {
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char letter : value) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

void add_line(std::string& text, const std::vector<Cell>& cells) {
  const char* separator = "";
  for (const Cell& cell : cells) {
    text += separator + std::visit([](const auto& value) { return csv_text(value); }, cell);
    separator = ",";
  }
  text += "\n";
}

std::string cell_text(const Cell& cell) {
  if (const auto* const text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* const value = std::get_if<double>(&cell)) return rounded(*value, 4);
  return std::to_string(std::get<std::uint64_t>(cell));
}

}  // namespace

std::vector<Column> columns_of(const std::vector<std::string>& texts) {
  std::vector<Column> columns;
  for (const std::string& text : texts) {
    const std::size_t end = text.find(": ");
    columns.push_back({text.substr(0, end), end == std::string::npos ? text : text.substr(end + 2)});
    if (end == std::string::npos) std::ranges::replace(columns.back().title, '_', ' ');
  }
  return columns;
}

std::string csv_of(const ResultTable& table) {
  std::string text;
  std::vector<Cell> names;
  for (const Column& column : table.columns) names.emplace_back(column.name);
  add_line(text, names);
  for (const std::vector<Cell>& row : table.rows) add_line(text, row);
  return text;
}

std::string csv_of(const Figure& figure) {
  std::string text = "series,x,y,label\n";
  for (const Series& series : figure.series)
    for (std::size_t i = 0; i < series.x.size(); ++i)
      add_line(text, {series.name, series.x[i], series.y[i],
                      series.labels.empty() ? std::string() : series.labels[i]});
  return text;
}

std::string markdown_of(const ResultTable& table) {
  std::vector<TextColumn> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const bool is_text = !table.rows.empty() && std::holds_alternative<std::string>(table.rows.front()[i]);
    columns.push_back({table.columns[i].title, 0, is_text ? Align::left : Align::right});
  }
  const TextTable lines(std::move(columns));
  std::string text = "**" + markdown_text(table.title) + "**\n\n" + lines.head();
  for (const std::vector<Cell>& row : table.rows) {
    std::vector<std::string> cells(row.size());
    std::ranges::transform(row, cells.begin(), cell_text);
    text += lines.row(cells);
  }
  return text + "\n";
}

}  // namespace graze::tools
