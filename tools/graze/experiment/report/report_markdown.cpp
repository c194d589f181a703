#include "experiment/report/report_markdown.hpp"

#include <cmath>
#include <vector>

#include "text_format.hpp"

namespace graze::tools {
namespace {

const char* introduction =
    R"(# The paper's experiments, and speed against error

`graze experiment all` measures all of this anew and writes this page; `tools/experiments.sh` installs what is missing,
builds graze and runs it. The paper is *A Distance Hierarchy to Detect Collisions Between Deformable Objects* (Madera,
Day, Laycock); its equations and tables are cited by their numbers, and `docs/method.md` tells its method in other words.
Every table, also those too long for this page, and the points of every figure are among the CSV files that it writes.
All steps run on one thread. Times are of the machine that wrote this page; everything else is the same in a second run.

)";

std::string text_of(double value) {
  return std::isfinite(value) ? format("%.4g", value) : "–";
}

std::string text_of(std::uint64_t value) {
  return std::to_string(value);
}

/// On one line, with no bar that would end a cell and nothing that would begin a tag.
std::string text_of(const std::string& value) {
  std::string text;
  for (const char letter : value) {
    if (letter == '|') {
      text += "\\|";
    } else if (letter == '<') {
      text += "&lt;";
    } else {
      text += letter == '\n' ? ' ' : letter;
    }
  }
  return text;
}

std::string row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

bool is_text(const ResultTable& table, std::size_t column) {
  return !table.rows.empty() && std::holds_alternative<std::string>(table.rows.front()[column]);
}

std::string table_of(const ResultTable& table) {
  std::vector<std::string> titles, rules;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    titles.push_back(text_of(table.columns[column].title));
    rules.emplace_back(is_text(table, column) ? ":--" : "--:");
  }
  std::string text = "**" + text_of(table.title) + "**\n\n" + row(titles) + row(rules);
  for (const std::vector<Cell>& cells : table.rows) {
    std::vector<std::string> texts;
    texts.reserve(cells.size());
    for (const Cell& cell : cells)
      texts.push_back(std::visit([](const auto& value) { return text_of(value); }, cell));
    text += row(texts);
  }
  return text + "\n";
}

std::string claims_of(const std::vector<Claim>& claims) {
  if (claims.empty()) return "";
  std::string text = row({"the paper says", "measured", "holds"}) + row({":--", ":--", ":--"});
  for (const Claim& claim : claims)
    text += row({text_of(claim.said), text_of(claim.measured), text_of(claim.holds)});
  return text + "\n";
}

std::string section_of(const Study& study, const ImageOf& image_of) {
  std::string text = "<a id=\"" + study.name + "\"></a>\n\n## " + text_of(study.title) + "\n\n" + study.text;
  while (text.ends_with('\n')) text.pop_back();
  text += "\n\n" + claims_of(study.claims);
  for (const std::string& violation : study.violations) text += "**Does not hold:** " + violation + "\n\n";
  for (const Figure& figure : study.figures) {
    const std::string image = image_of(study, figure);
    if (!image.empty()) text += "![" + text_of(figure.title) + "](" + image + ")\n\n";
  }
  for (const ResultTable& table : study.tables)
    if (table.shown) text += table_of(table);
  return text;
}

}  // namespace

std::string markdown_of(std::span<const Study> studies, const ImageOf& image_of) {
  std::string text = introduction;
  for (const Study& study : studies) text += "- [" + text_of(study.title) + "](#" + study.name + ")\n";
  text += "\n";
  for (const Study& study : studies) text += section_of(study, image_of);
  text.pop_back();  // one newline ends the file
  return text;
}

}  // namespace graze::tools
