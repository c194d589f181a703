// Frames of simulations as scenes: what one swept surface meets of itself, against exact answers.

#include <algorithm>
#include <array>
#include <cstdint>
#include <graze/graze.hpp>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "core/sweep/sequence.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// Whether two edges meet, or a vertex and a face, and their indices in the mesh.
using Meeting = std::tuple<bool, std::size_t, std::size_t>;

std::set<Meeting> expected_meetings(const Sequence& sequence, const Mesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> edge_of;
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) edge_of[mesh.edge(edge)] = edge;
  std::set<Meeting> expected;
  for (const Sequence::Pair& pair : sequence.pairs) {
    if (!pair.meet) continue;
    auto [a, b] = pair.features;
    if (pair.are_edges) {
      const std::uint32_t first = edge_of.at(sequence.edges[a]);
      const std::uint32_t second = edge_of.at(sequence.edges[b]);
      a = std::min(first, second);
      b = std::max(first, second);
    }
    expected.emplace(pair.are_edges, a, b);
  }
  return expected;
}

void check_scene(const std::string& name, int first) {
  const auto sequence = read_sequence(name, first);
  if (!sequence) return;
  const auto mesh = mesh_of(sequence->start);
  Scene scene(settings_of(0, 0, ContactDetail::none));
  ObjectSettings object;
  object.self = object.swept = true;
  const ObjectId id = scene.add(mesh, object);
  (void)scene.step();
  scene.set_positions(id, sequence->end);
  const ReportHandle report = scene.step();
  CHECK(report->complete());
  std::set<Meeting> found;
  std::size_t uncertain = 0;
  double widest = 0;
  for (const Impact& impact : report->impacts(only_pair(*report))) {
    found.emplace(impact.kind == ContactKind::EE, impact.feature_a.index, impact.feature_b.index);
    if (impact.status == ImpactStatus::possible) ++uncertain;
    widest = std::max(widest, impact.upper - impact.lower);
  }
  CHECK(found.size() == report->impacts().size());
  CHECK(uncertain == 0);
  CHECK(widest <= 1e-6);
  CHECK(found == expected_meetings(*sequence, *mesh));
}

}  // namespace

TEST_CASE("In a step of a cloth that falls through a funnel exactly those features meet that do") {
  check_scene("cloth-funnel", 227);
}

TEST_CASE("In a step of an armadillo between rollers exactly those features meet that do") {
  check_scene("armadillo-rollers", 326);
}

}  // namespace graze::tests
