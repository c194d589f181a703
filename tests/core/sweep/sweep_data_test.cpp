// Queries of continuous collision with known answers (../shared/data/README.md).

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/floating_point_scope.hpp"
#include "core/mesh_files.hpp"
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

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The whole numbers of a text, two by two.
std::vector<std::array<std::size_t, 2>> read_pairs(const std::filesystem::path& file) {
  std::string text = text_of(file);
  for (char& character : text)
    if (character < '0' || character > '9') character = ' ';
  std::istringstream numbers(text);
  std::vector<std::array<std::size_t, 2>> pairs;
  std::array<std::size_t, 2> pair{};
  while (numbers >> pair[0] >> pair[1]) pairs.push_back(pair);
  return pairs;
}

/// The words "true" and "false" of a text.
std::vector<bool> read_answers(const std::filesystem::path& file) {
  std::vector<bool> answers;
  for (const char character : text_of(file))
    if (character == 't' || character == 'f') answers.push_back(character == 't');
  return answers;
}

/// Two frames of a sequence, and its edges by their ids.
struct Frames {
  oracle::Shape start, end;
  std::vector<std::array<std::uint32_t, 2>> edges;

  Frames(const std::filesystem::path& folder, int first)
      : start(read_ply((folder / (std::to_string(first) + ".ply")).string())),
        end(read_ply((folder / (std::to_string(first + 1) + ".ply")).string())) {
    std::set<std::array<std::uint32_t, 2>> by_larger_end;
    for (const auto& face : start.faces)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(face[i], face[(i + 1) % 3]);
        by_larger_end.insert({high, low});
      }
    for (const auto& edge : by_larger_end) edges.push_back({edge[1], edge[0]});
  }

  [[nodiscard]] SweepQuery query(const std::array<std::size_t, 2>& ids, bool are_edges, bool meet) const {
    const std::size_t vertices = start.positions.size();
    std::array<std::uint32_t, 4> vertex{};
    if (are_edges) {
      const auto& a = edges[ids[0] - vertices];
      const auto& b = edges[ids[1] - vertices];
      vertex = {a[0], a[1], b[0], b[1]};
    } else {
      const auto& face = start.faces[ids[1] - vertices - edges.size()];
      vertex = {static_cast<std::uint32_t>(ids[0]), face[0], face[1], face[2]};
    }
    SweepQuery result;
    for (std::size_t i = 0; i < 4; ++i) {
      result.sweep.start[i] = start.positions[vertex[i]];
      result.sweep.end[i] = end.positions[vertex[i]];
    }
    result.are_edges = are_edges;
    result.meet = meet;
    return result;
  }
};

void check_sequence(const std::string& name, int first) {
  const std::filesystem::path folder = std::filesystem::path(GRAZE_SHARED_DATA) / "sequences" / name;
  if (!has_folder(folder)) return;
  const Frames frames(folder / "frames", first);
  SweepTally tally;
  for (const bool are_edges : {false, true}) {
    const std::string file = std::to_string(first) + (are_edges ? "ee" : "vf");
    const auto pairs = read_pairs(folder / "boxes" / (file + ".json"));
    const auto answers = read_answers(folder / "mma_bool" / (file + "_mma_bool.json"));
    REQUIRE(!pairs.empty());
    REQUIRE(pairs.size() == answers.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) tally.add(frames.query(pairs[i], are_edges, answers[i]));
  }
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
