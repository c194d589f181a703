// `graze_studies accuracy` as a user runs it: what its page's tables say, that they are the same again, bad
// arguments.

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;  // NOLINT: the vocabulary of these tests

namespace {

/// One row of a table: its cells by the column's name.
using Row = std::map<std::string, std::string>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line.substr(2));
  for (std::string cell; std::getline(stream, cell, '|');) {
    const auto first = cell.find_first_not_of(' ');
    const auto last = cell.find_last_not_of(' ');
    if (first != std::string::npos) cells.push_back(cell.substr(first, last - first + 1));
  }
  return cells;
}

/// The rows of all tables whose first column has this name.
std::vector<Row> rows_of(const std::string& page, const std::string& first_column) {
  std::vector<Row> rows;
  std::vector<std::string> names;
  std::istringstream stream(page);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("| ")) {
      names.clear();
      continue;
    }
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
    } else if (names[0] == first_column && !cells[0].starts_with(":--")) {
      REQUIRE(cells.size() == names.size());
      Row row;
      for (std::size_t i = 0; i < cells.size(); ++i) row[names[i]] = cells[i];
      rows.push_back(row);
    }
  }
  return rows;
}

double number_of(const Row& row, const std::string& column) {
  INFO(column);
  REQUIRE(row.contains(column));
  std::istringstream stream(row.at(column));
  stream.imbue(std::locale::classic());
  double value = 0;
  REQUIRE(stream >> value);
  return value;
}

ProgramResult run_quickly(const std::filesystem::path& out, bool with_times) {
  std::vector<std::string> arguments = {"accuracy", "--quick", "--out", out.string()};
  if (!with_times) arguments.emplace_back("--no-times");
  return run_studies(arguments);
}

void check_kernels(const std::string& page) {
  std::map<std::string, double> contacts;
  std::size_t distance_rows = 0;
  for (const Row& row : rows_of(page, "kernel")) {
    INFO(row.at("kernel"));
    if (row.contains("wrong names")) {
      ++distance_rows;
      contacts[row.at("kernel")] += number_of(row, "contacts");
      CHECK(number_of(row, "wrong names") == 0);
      CHECK(number_of(row, "largest") <= 32);
      CHECK(number_of(row, "mean") <= number_of(row, "largest") + 0.01);  // both are rounded
    } else {
      CHECK(number_of(row, "points, largest") >= number_of(row, "points, mean"));
      CHECK(number_of(row, "normal, length − 1") < 1e-15);
    }
  }
  CHECK(distance_rows == 36);
  CHECK(contacts.size() == 12);
  for (const auto& [kernel, count] : contacts) {
    INFO(kernel);
    CHECK(count > 0);
  }
}

void check_settings(const std::string& page) {
  const std::vector<Row> rows = rows_of(page, "setting");
  std::size_t exact = 0;
  std::size_t within = 0;
  bool loses_something = false;
  for (const Row& row : rows) {
    const std::string& name = row.at("setting");
    INFO(name);
    CHECK(number_of(row, "broken bounds") == 0);
    CHECK(number_of(row, "width, largest") >= number_of(row, "width, mean"));
    const bool is_exact = name == "exact";
    const bool is_within = name.starts_with("within(");
    if (is_exact || is_within) {
      CHECK((row.at("found") == "100 %" || row.at("found") == "–"));
      CHECK((row.at("right") == "100 %" || row.at("right") == "–"));
      CHECK(row.at("touching found") == "100 %");
      CHECK(row.at("complete") == "100 %");
    } else {
      loses_something = loses_something || row.at("touching found") != "100 %";
    }
    if (is_exact) {
      ++exact;
      CHECK(number_of(row, "width, largest") < 1e-12);
      CHECK(row.at("above truth, mean") == "0");
      CHECK(row.at("below truth, mean") == "0");
    }
    if (is_within) {
      ++within;
      CHECK(number_of(row, "width, largest") <= std::stod(name.substr(7)));
    }
  }
  CHECK(exact == 4);
  CHECK(within == 14);
  CHECK(loses_something);
}

}  // namespace

TEST_CASE("accuracy: tables within the contract's bounds, the same again, times apart") {
  const TemporaryFolder folder;
  const ProgramResult first = run_quickly(folder / "first.md", false);
  INFO(first.err);
  REQUIRE(first.exit_code == 0);
  const std::string page = read_file(folder / "first.md");
  check_kernels(page);
  check_settings(page);
  CHECK(rows_of(page, "input").size() == 3);
  for (const Row& row : rows_of(page, "input")) CHECK(number_of(row, "wrong bounds") == 0);

  const bool can_plot = std::system("gnuplot --version >/dev/null 2>&1") == 0;
  const ProgramResult second = run_quickly(folder / "second.md", can_plot);
  INFO(second.err);
  REQUIRE(second.exit_code == 0);
  const std::string again = read_file(folder / "second.md");
  CHECK(again.starts_with(page));
  if (!can_plot) {
    CHECK(again == page);
    return;
  }
  CHECK(again.substr(page.size()).starts_with("\n## Time\n"));
  CHECK(again.find("](second.png)") != std::string::npos);
  CHECK(read_file(folder / "second.png").starts_with("\x89PNG"));
}

TEST_CASE("accuracy: bad arguments are refused in one line before anything is measured") {
  const TemporaryFolder folder;
  const std::string out = (folder / "page.md").string();
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"--count", "0"},
        {"--count", "many"},
        {"--count", "-3"},
        {"--seed", "x"},
        {"--quack"},
        {"--no-times", "--out", (folder / "none" / "page.md").string()}}) {
    std::vector<std::string> arguments = {"accuracy"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const ProgramResult result = run_studies(arguments);
    INFO(bad[0] << " gave " << result.err);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK(result.out.empty());
  }
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const ProgramResult without_gnuplot = run_studies({"accuracy", "--quick", "--out", out});
  setenv("PATH", path.c_str(), 1);
  CHECK(without_gnuplot.exit_code == 2);
  CHECK(is_one_line(without_gnuplot.err));
  CHECK(without_gnuplot.err.find("gnuplot") != std::string::npos);
  CHECK(!std::filesystem::exists(out));
}
