// Queries of continuous collision with known answers (../shared/data/README.md).

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/floating_point_scope.hpp"
#include "core/sweep/sequence.hpp"
#include "support/catch.hpp"
#include "sweep/moving_features.hpp"

namespace graze::tests {
namespace {

struct SweepQuery {
  FeatureSweep sweep;
  bool are_edges = false;
  bool meet = false;
};

/// Counts what differs from the known answers.
struct SweepTally {
  std::size_t queries = 0;
  std::size_t missed = 0;
  std::size_t wrong = 0;
  double widest = 0;
  SweepCounters counters;

  void add(const SweepQuery& query) {
    const SweepPrecision precision;
    const auto meeting = query.are_edges ? meet_edge_edge(query.sweep, precision, counters)
                                         : meet_vertex_face(query.sweep, precision, counters);
    ++queries;
    if (query.meet && !meeting) ++missed;
    if (!query.meet && meeting) ++wrong;
    if (meeting) widest = std::max(widest, meeting->upper - meeting->lower);
  }

  void check() const {
    CHECK(missed == 0);
    CHECK(wrong == 0);
    CHECK(widest <= 1e-6);
    CHECK(counters.undecided == 0);
    std::cout << "sweep: " << queries << " queries, " << counters.discarded << " discarded, "
              << counters.in_double << " decided in double, " << counters.exact << " exactly, bounds at most "
              << widest << " apart\n";
  }
};

/// Says so and returns false where a folder of the shared data is missing.
bool has_folder(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder)) return true;
  std::cout << "skipped: there is no " << folder.string() << "\n";
  return false;
}

/// Eight rows of three rational numbers each, which are doubles.
std::vector<SweepQuery> read_queries(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<SweepQuery> queries;
  std::string line;
  for (std::size_t row = 0; std::getline(in, line) && !line.empty(); row = (row + 1) % 8) {
    std::istringstream numbers(line);
    std::array<double, 7> number{};
    std::string text;
    for (double& value : number) {
      std::getline(numbers, text, ',');
      value = std::strtod(text.c_str(), nullptr);
    }
    if (row == 0) queries.emplace_back();
    SweepQuery& query = queries.back();
    query.are_edges = file.parent_path().filename() == "edge-edge";
    query.meet = number[6] != 0;
    (row < 4 ? query.sweep.start[row] : query.sweep.end[row - 4]) = {
        number[0] / number[1], number[2] / number[3], number[4] / number[5]};
  }
  return queries;
}

SweepQuery query_of(const Sequence& sequence, const Sequence::Pair& pair) {
  std::array<std::uint32_t, 4> vertex{};
  if (pair.are_edges) {
    const auto& a = sequence.edges[pair.features[0]];
    const auto& b = sequence.edges[pair.features[1]];
    vertex = {a[0], a[1], b[0], b[1]};
  } else {
    const auto& face = sequence.start.faces[pair.features[1]];
    vertex = {static_cast<std::uint32_t>(pair.features[0]), face[0], face[1], face[2]};
  }
  SweepQuery result;
  for (std::size_t i = 0; i < 4; ++i) {
    result.sweep.start[i] = sequence.start.positions[vertex[i]];
    result.sweep.end[i] = sequence.end[vertex[i]];
  }
  result.are_edges = pair.are_edges;
  result.meet = pair.meet;
  return result;
}

void check_sequence(const std::string& name, int first) {
  const auto sequence = read_sequence(name, first);
  if (!sequence) return;
  SweepTally tally;
  for (const Sequence::Pair& pair : sequence->pairs) tally.add(query_of(*sequence, pair));
  tally.check();
}

}  // namespace

TEST_CASE("sweep: 5,029 queries with exact answers are decided without a miss and without a false impact") {
  const FloatingPointScope scope;
  const std::filesystem::path folder = std::filesystem::path(GRAZE_SHARED_DATA) / "ccd";
  if (!has_folder(folder)) return;
  SweepTally tally;
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder))
    if (file.path().extension() == ".csv")
      for (const SweepQuery& query : read_queries(file.path())) tally.add(query);
  CHECK(tally.queries == 5029);
  tally.check();
}

TEST_CASE("sweep: pairs of features of two sequences meet where exact answers say so") {
  const FloatingPointScope scope;
  check_sequence("cloth-funnel", 227);
  check_sequence("armadillo-rollers", 326);
}

}  // namespace graze::tests
