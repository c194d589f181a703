#include "experiment/report/report_csv.hpp"

#include <array>
#include <charconv>
#include <vector>

#include "experiment/report/text_file.hpp"

namespace graze::tools {
namespace {

std::string text_of(double value) {
  std::array<char, 32> text;
  auto* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string text_of(std::uint64_t value) {
  return std::to_string(value);
}

std::string text_of(const std::string& value) {
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char letter : value) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

void add_line(std::string& text, const std::vector<Cell>& cells) {
  const char* separator = "";
  for (const Cell& cell : cells) {
    text += separator + std::visit([](const auto& value) { return text_of(value); }, cell);
    separator = ",";
  }
  text += "\n";
}

}  // namespace

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

void write_csv(const std::filesystem::path& folder, std::span<const Study> studies) {
  for (const Study& study : studies) {
    for (const ResultTable& table : study.tables)
      write_text_file(folder / (study.name + "_" + table.name + ".csv"), csv_of(table));
    for (const Figure& figure : study.figures)
      write_text_file(folder / (study.name + "_" + figure.name + ".points.csv"), csv_of(figure));
  }
}

}  // namespace graze::tools
