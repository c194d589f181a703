// `graze_studies experiment`: what it writes, that it is the same again, what makes it fail; and the Pareto
// front.

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "check_failed.hpp"
#include "experiment/report/run_studies.hpp"
#include "experiment/speed/pareto.hpp"
#include "figures/figure_plot.hpp"
#include "figures/html_page.hpp"
#include "figures/result_table.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"
#include "tools/program.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;  // NOLINT: the vocabulary of these tests
using namespace graze::tools;  // NOLINT

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// As RFC 4180 has it, but for lines that end in \n.
Rows parse_csv(const std::string& text) {
  Rows rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (quoted && letter == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (letter == '"') {
      quoted = !quoted;
    } else if (!quoted && letter == ',') {
      rows.back().emplace_back();
    } else if (!quoted && letter == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += letter;
    }
  }
  CHECK(!quoted);
  CHECK(rows.back() == std::vector<std::string>{""});  // a newline ends the last line
  rows.pop_back();
  return rows;
}

/// Describes why a page is not XML; empty if it is. The faults are tags that do not close in order, and a
/// bare & or <.
std::string fault_of(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < html.size(); ++i) {
    if (html[i] == '&') {
      const std::size_t end = html.find(';', i);
      if (end == std::string::npos || end - i > 8) return "a bare & at " + html.substr(i, 30);
    }
    if (html[i] != '<' || html.compare(i, 2, "<!") == 0) continue;
    const std::size_t end = html.find('>', i);
    if (end == std::string::npos) return "no end of " + html.substr(i, 30);
    const std::string tag = html.substr(i + 1, end - i - 1);
    const std::string name =
        tag.substr(tag.starts_with('/') ? 1 : 0, tag.find_first_of(" /", 1) - (tag.starts_with('/') ? 1 : 0));
    i = end;
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

/// Every file under a folder, by its name there.
std::map<std::string, std::string> files_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] = read_file(entry.path());
  return files;
}

std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++count;
  return count;
}

/// One of everything that a study may have.
Study small_study() {
  Study study{"small", "A study & its <parts>", "First *paragraph*, with a < b.\n\nSecond.", {}, {}, {}, {}};
  study.tables.push_back(
      {"counts",
       "Counts | bars",
       {{"name", "name"}, {"count", "count"}, {"share", "share"}},
       {{"a, \"b\"", std::uint64_t{18446744073709551615U}, 0.1}, {"c|d", std::uint64_t{0}, 1e-300}}});
  study.tables.push_back({"times", "Times", {{"ms", "ms"}}, {{1.5}}, true});
  study.tables.push_back({"long", "Long", {{"x", "x"}}, {{2.0}}, false, false});
  study.figures.push_back({"line",
                           "A line's title",
                           "x",
                           "y",
                           true,
                           true,
                           false,
                           {{"one", {1, 10, 100}, {0, 0.5, 2}, true, {"p", "q \"r\"", ""}}}});
  study.figures.push_back(
      {"clock", "Clock", "x", "y", false, false, true, {{"two", {1, 2}, {3, 4}, false, {}}}});
  study.claims.push_back({"it is so", "it is", "yes"});
  return study;
}

ExperimentOptions options_for(const std::filesystem::path& out, bool times) {
  ExperimentOptions options;
  options.out = out;
  options.times = times;
  return options;
}

const std::vector<std::string> quick = {"--frames", "2", "--no-times", "--data", "no-such-folder"};

ProgramResult run_all(const std::filesystem::path& folder) {
  std::vector<std::string> arguments = {
      "experiment", "all", "--out", (folder / "out").string(), "--docs", (folder / "docs").string()};
  arguments.insert(arguments.end(), quick.begin(), quick.end());
  return run_studies(arguments);
}

}  // namespace

TEST_CASE("experiment: the Pareto front is what nothing beats, by brute force") {
  graze::oracle::Random random(3);
  for (int round = 0; round < 300; ++round) {
    std::vector<CostAndError> points(random.below(20));
    for (CostAndError& point : points)  // few values, so that there are ties
      point = {static_cast<double>(random.below(6)), static_cast<double>(random.below(6))};
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool beaten = std::ranges::any_of(points, [&](const CostAndError& other) {
        return other.cost <= points[i].cost && other.error <= points[i].error &&
               (other.cost < points[i].cost || other.error < points[i].error);
      });
      if (!beaten) expected.push_back(i);
    }
    std::vector<std::size_t> front = pareto_front(points);
    CHECK(std::ranges::is_sorted(front, {}, [&](std::size_t i) { return points[i].cost; }));
    std::ranges::sort(front);
    CHECK(front == expected);
  }
}

TEST_CASE("experiment: numbers and texts of a CSV file read back as they were") {
  const Study study = small_study();
  const Rows rows = parse_csv(csv_of(study.tables[0]));
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == std::vector<std::string>{"name", "count", "share"});
  CHECK(rows[1] == std::vector<std::string>{"a, \"b\"", "18446744073709551615", "0.1"});
  CHECK(rows[2] == std::vector<std::string>{"c|d", "0", "1e-300"});
  CHECK(parse_csv(csv_of(study.figures[0])) == Rows{{"series", "x", "y", "label"},
                                                    {"one", "1", "0", "p"},
                                                    {"one", "10", "0.5", "q \"r\""},
                                                    {"one", "100", "2", ""}});
}

TEST_CASE("experiment: an SVG is held by its address") {
  CHECK(data_address_of("") == "data:image/svg+xml;base64,");
  CHECK(data_address_of("M") == "data:image/svg+xml;base64,TQ==");
  CHECK(data_address_of("Ma") == "data:image/svg+xml;base64,TWE=");
  CHECK(data_address_of("Man") == "data:image/svg+xml;base64,TWFu");
  CHECK(data_address_of("light work.") == "data:image/svg+xml;base64,bGlnaHQgd29yay4=");
}

TEST_CASE("experiment: a report has every table that is shown and every figure, times only where asked for") {
  const TemporaryFolder folder;
  const std::vector<StudyMaker> makers = {{"small", [](const ExperimentOptions&) { return small_study(); }}};
  for (const bool times : {false, true}) {
    const std::filesystem::path out = folder / (times ? "with" : "without");
    run_studies(makers, options_for(out, times), out / "docs");
    auto files = files_in(out);
    CHECK(files.contains("small_counts.csv"));
    CHECK(files.contains("small_long.csv"));
    CHECK(files.contains("small_times.csv") == times);
    CHECK(files.contains("small_clock.points.csv") == times);
    CHECK(fault_of(files["experiments.html"]) == "");
    const std::string& page = files["docs/experiments.md"];
    CHECK(count_of("Counts", page) == 1);
    CHECK(count_of("**Times**", page) == (times ? 1 : 0));
    CHECK(count_of("**Long**", page) == 0);
    CHECK(count_of("- it is so. **Measured:** it is. **Holds:** yes.\n", page) == 1);
    const std::size_t figures = has_gnuplot() ? (times ? 2 : 1) : 0;
    CHECK(count_of("<img ", files["experiments.html"]) == figures);
    CHECK(count_of("![", page) == figures + 2);  // with two of the viewer
    if (figures == 0) continue;
    CHECK(page.find("![A line's title](experiments/small_line.png)") != std::string::npos);
    CHECK(files["docs/experiments/small_line.png"].starts_with("\x89PNG"));
    CHECK(fault_of(files["figures/small_line.svg"].substr(files["figures/small_line.svg"].find("<svg")))
              .empty());
    CHECK(files.contains("figures/small_clock.svg") == times);
  }
}

TEST_CASE("experiment: what does not hold fails the command, after all is written") {
  const TemporaryFolder folder;
  Study study = small_study();
  study.violations = {"two is not one", "three is not one"};
  const std::vector<StudyMaker> makers = {
      {"first", [&](const ExperimentOptions&) { return study; }},
      {"second", [](const ExperimentOptions&) -> Study { throw CheckFailed("four is not one"); }},
      {"third", [](const ExperimentOptions&) {
         Study other = small_study();
         other.name = "third";
         return other;
       }}};
  CHECK_THROWS_AS(run_studies(makers, options_for(folder / "out", false), ""), CheckFailed);
  CHECK_THROWS_WITH(run_studies(makers, options_for(folder / "out", false), ""),
                    "two is not one (3 violations in all)");
  auto files = files_in(folder / "out");
  CHECK(files.contains("small_counts.csv"));
  CHECK(files.contains("third_counts.csv"));
  CHECK(files["experiments.html"].find("three is not one") != std::string::npos);
}

TEST_CASE("experiment: every study writes its files, and the same in a second run") {
  const TemporaryFolder folder;
  const ProgramResult first = run_all(folder / "first");
  INFO(first.err);
  REQUIRE(first.exit_code == 0);
  const auto files = files_in(folder / "first");
  CHECK(fault_of(files.at("out/experiments.html")) == "");
  std::size_t tables = 0;
  for (const auto& [name, text] : files) {
    if (!name.ends_with(".csv")) continue;
    INFO(name);
    const Rows rows = parse_csv(text);
    REQUIRE(rows.size() > 1);
    for (const std::vector<std::string>& row : rows) CHECK(row.size() == rows[0].size());
    ++tables;
  }
  CHECK(tables > 0);
  for (const char* study : {"subdivision", "speed"}) {
    INFO(study);
    CHECK(files.at("docs/experiments.md").find("<a id=\"" + std::string(study) + "\">") != std::string::npos);
  }
  const ProgramResult second = run_all(folder / "second");
  CHECK(second.exit_code == 0);
  CHECK(files_in(folder / "second") == files);
}

TEST_CASE("experiment: bad arguments are refused in one line before anything is measured") {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "").string();
  for (const std::vector<std::string>& bad : {std::vector<std::string>{},
                                              {"4"},
                                              {"all", "--frames", "0"},
                                              {"all", "--frames", "many"},
                                              {"all", "--runs", "0"},
                                              {"speed", "--docs", (folder / "docs").string()},
                                              {"speed", "--out", file},
                                              {"speed", "--out", file + "/below"}}) {
    std::vector<std::string> arguments = {"experiment"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const ProgramResult result = run_studies(arguments);
    INFO((bad.empty() ? "nothing" : bad.back()) << " gave " << result.err);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK(result.out.empty());
  }
}
