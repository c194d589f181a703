// `graze_studies stress` as a user runs it: short runs of each study, what they write, bad arguments.

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;  // NOLINT: the vocabulary of these tests

namespace {

/// Runs `graze_studies stress` with these arguments, which must succeed, and gives the figures that it wrote.
nlohmann::json figures_of(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  const std::string out = (folder / "figures.json").string();
  arguments.insert(arguments.begin(), "stress");
  arguments.insert(arguments.end(), {"--out", out});
  const ProgramResult result = run_studies(arguments);
  INFO(result.err);
  INFO(result.out);
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK_FALSE(result.out.empty());
  return nlohmann::json::parse(read_file(out));
}

void check_quantiles(const nlohmann::json& figures) {
  CHECK(figures.at("p50").get<double>() >= 0);
  CHECK(figures.at("p50") <= figures.at("p99"));
  CHECK(figures.at("p99") <= figures.at("p99.9"));
  CHECK(figures.at("p99.9") <= figures.at("max"));
}

}  // namespace

TEST_CASE("stress: a reader at 1 kHz sees new reports, beside a control") {
  const nlohmann::json figures = figures_of({"--reader", "--seconds", "1"});
  CHECK(figures.at("reads") == 1000);
  CHECK(figures.at("retries") == 0);
  CHECK(figures.at("frames_seen") >= 1);
  CHECK(figures.at("frames_seen") <= figures.at("steps"));
  for (const char* reader : {"read", "control"})
    for (const char* what : {"wall", "cpu", "late"}) check_quantiles(figures.at(reader).at(what));
}

TEST_CASE("stress: scenes of more and more objects at one density") {
  const nlohmann::json figures = figures_of({"--objects", "216,1000", "--frames", "2"});
  REQUIRE(figures.at("objects").size() == 2);
  const auto& small = figures.at("objects")[0];
  const auto& large = figures.at("objects")[1];
  CHECK(small.at("count") == 216);
  CHECK(large.at("count") == 1000);
  // Memory follows the objects and their pairs, but for what a thread works with.
  CHECK(large.at("bytes") > 1.2 * small.at("bytes").get<double>());
  CHECK(large.at("bytes") < 6 * small.at("bytes").get<double>());
  CHECK(large.at("pairs_in_contact") > 0);
  CHECK(large.at("hash") != small.at("hash"));
  CHECK(figures.at("large_pair").at("pairs_in_contact") == 1);
  CHECK(figures.at("large_pair").at("control_speedup") > 0);
  for (const auto& run : {large, figures.at("large_pair")})
    for (const char* fraction : {"serial_fraction", "serial_fraction_by_phases"}) {
      CHECK(run.at(fraction) >= 0.0);
      CHECK(run.at(fraction) <= 1.0);
    }
}

TEST_CASE("stress: reading beside a plain loop that reads and copies as much") {
  const nlohmann::json figures = figures_of({"--reading", "300", "--frames", "2"});
  REQUIRE(figures.at("reading").size() == 16);
  std::map<std::string, std::uint64_t> copied;
  for (const auto& row : figures.at("reading")) {
    CHECK(row.at("step_ms") > 0);
    CHECK(row.at("plain_ms") > 0);
    copied[row.at("positions").get<std::string>()] = row.at("copied");
  }
  CHECK(copied.at("bound, nothing near") == 0);
  CHECK(copied.at("bound, as in S5") > 0);
  CHECK(copied.at("bound, as in S5") < copied.at("bound, most near"));
  CHECK(copied.at("copied by calls") == 300);
}

TEST_CASE("stress: a small scene beside a large one") {
  const nlohmann::json figures = figures_of({"--together", "--frames", "4"});
  REQUIRE(figures.at("together").size() == 14);
  for (const auto& row : figures.at("together")) {
    CHECK(row.at("hash") == figures.at("together")[0].at("hash"));
    for (const char* what : {"alone_ms", "beside_ms"}) check_quantiles(row.at(what));
  }
}

TEST_CASE("stress: a short soak equals scenes built afresh and does not grow") {
  const nlohmann::json figures = figures_of({"--soak", "--frames", "300"});
  CHECK(figures.at("checks") == 3);
  CHECK(figures.at("frames") == 303);  // one more for each that is looked at
  CHECK(figures.at("reports_held") > 2);
  CHECK(figures.at("intervals").size() == 30);
  std::uint64_t diagnostics = 0;
  for (const auto& interval : figures.at("intervals"))
    diagnostics += interval.at("diagnostics").get<std::uint64_t>();
  CHECK(diagnostics > 10);
}

TEST_CASE("stress: scenes play the same with any number of threads") {
  const nlohmann::json figures = figures_of({"--determinism", "--frames", "3", "--repeats", "1"});
  REQUIRE(figures.at("scenes").size() == 12);
  for (const auto& scene : figures.at("scenes")) CHECK(scene.at("contacts") > 0);
}

TEST_CASE("stress: bad arguments are refused in one line") {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"--quack"},
        {"--reader", "--soak"},
        {"--reader", "--seconds", "0"},
        {"--soak", "--minutes", "-1"},
        {"--objects", "1"},
        {"--objects", "many"},
        {"--reading", "1"},
        {"--together", "--reading", "100"},
        {"--determinism", "--repeats", "0"},
        {"--reader", "--seconds", "1", "--out", (folder / "none" / "figures.json").string()}}) {
    std::vector<std::string> arguments = {"stress"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const ProgramResult result = run_studies(arguments);
    INFO(bad[0] << " gave " << result.err);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK(result.out.empty());
  }
  CHECK(run_studies({"stress"}).exit_code == 2);
}
