// Sweeps of two surfaces, and of one with itself, against each feature tested with each other feature.

#include "core/sweep/pair_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <tuple>
#include <vector>

#include "core/base/floating_point_scope.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/mesh_of.hpp"
#include "support/random/random_scenes.hpp"
#include "sweep/moving_features.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;
using Positions = std::vector<Vector3d>;

/// A surface that moves from a shape to other positions of its vertices.
struct MovingShape {
  MovingShape(const Shape& from, const Positions& to) : start(from), end(to), surface(mesh_of(from)) {
    motion.make_room(surface);
    motion.keep(surface, 0, surface.mesh().vertex_count());
    motion.finish(surface);
    surface.set_positions(PositionView(end));
    motion.make_boxes(surface, true);
  }
  [[nodiscard]] MovingSurface way() const { return motion.way(surface, true); }

  Shape start;
  Positions end;
  Surface surface;
  SurfaceMotion motion;
};

SweepAnswer swept(const MovingShape& a, const MovingShape& b, const SweepQuery& query) {
  const FloatingPointScope scope;
  PairSweep sweep;
  SweepAnswer answer;
  SweepWork work;
  sweep.sweep(a.way(), b.way(), query, answer, work);
  return answer;
}

SweepAnswer swept_with_itself(const MovingShape& a) {
  SweepQuery query;
  query.is_self = true;
  return swept(a, a, query);
}

/// The way of four vertices: each is one of a or of b.
struct Corner {
  const MovingShape* of;
  std::uint32_t vertex;
};
FeatureSweep way_of(const std::array<Corner, 4>& corners) {
  FeatureSweep sweep;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sweep.start[i] = corners[i].of->start.positions[corners[i].vertex];
    sweep.end[i] = corners[i].of->end[corners[i].vertex];
  }
  return sweep;
}

/// All impacts, by testing each feature with each other one.
class BruteForce {
 public:
  BruteForce(const MovingShape& a, const MovingShape& b, bool is_self) : a_(a), b_(b), is_self_(is_self) {
    test_vertices(a, b, false);
    if (!is_self) test_vertices(b, a, true);
    test_edges();
    std::sort(impacts.begin(), impacts.end(), [](const Impact& left, const Impact& right) {
      return std::tie(left.lower, left.kind, left.feature_a, left.feature_b) <
             std::tie(right.lower, right.kind, right.feature_a, right.feature_b);
    });
  }

  std::vector<Impact> impacts;

 private:
  void test_vertices(const MovingShape& of_vertex, const MovingShape& of_face, bool turned) {
    const IndexedMesh& mesh = of_face.surface.mesh();
    for (std::uint32_t vertex = 0; vertex < of_vertex.surface.mesh().vertex_count(); ++vertex) {
      if (!of_vertex.surface.mesh().is_used(vertex)) continue;
      for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const auto corners = mesh.face(face);
        if (is_self_ && std::find(corners.begin(), corners.end(), vertex) != corners.end()) continue;
        std::vector<SweptMeeting> meetings;
        for (std::size_t last = 2; last < corners.size(); ++last)
          if (const auto meeting = meet_vertex_face(way_of({{{&of_vertex, vertex},
                                                             {&of_face, corners[0]},
                                                             {&of_face, corners[last - 1]},
                                                             {&of_face, corners[last]}}}),
                                                    {}, counters_))
            meetings.push_back(*meeting);
        if (meetings.empty()) continue;
        // The earlier triangle of a quad says when the vertex comes to it.
        SweptMeeting first = meetings.front();
        for (const SweptMeeting& meeting : meetings) {
          first.lower = std::min(first.lower, meeting.lower);
          first.upper = std::min(first.upper, meeting.upper);
          if (meeting.status == ImpactStatus::at_start) first.status = ImpactStatus::at_start;
        }
        Feature point{FeatureKind::vertex, vertex};
        Feature area{FeatureKind::face, face};
        if (turned) std::swap(point, area);
        impacts.push_back({ContactKind::VF, point, area, first.lower, first.upper, first.status});
      }
    }
  }
  void test_edges() {
    const IndexedMesh& mesh_a = a_.surface.mesh();
    const IndexedMesh& mesh_b = b_.surface.mesh();
    for (std::uint32_t edge_a = 0; edge_a < mesh_a.edge_count(); ++edge_a)
      for (std::uint32_t edge_b = is_self_ ? edge_a + 1 : 0; edge_b < mesh_b.edge_count(); ++edge_b) {
        const auto [a0, a1] = mesh_a.edge(edge_a);
        const auto [b0, b1] = mesh_b.edge(edge_b);
        if (is_self_ && (a0 == b0 || a0 == b1 || a1 == b0 || a1 == b1)) continue;
        const auto meeting =
            meet_edge_edge(way_of({{{&a_, a0}, {&a_, a1}, {&b_, b0}, {&b_, b1}}}), {}, counters_);
        if (meeting)
          impacts.push_back({ContactKind::EE,
                             {FeatureKind::edge, edge_a},
                             {FeatureKind::edge, edge_b},
                             meeting->lower,
                             meeting->upper,
                             meeting->status});
      }
  }

  const MovingShape& a_;
  const MovingShape& b_;
  bool is_self_;
  SweepCounters counters_;
};

/// A soup on its way, for odd seeds on a grid. Some stand still, and some move by many times their size.
MovingShape random_motion(std::uint64_t seed, std::uint32_t vertices, std::uint32_t faces) {
  const Shape start = random_soup(seed, vertices, faces);
  Random random(seed + 1000);
  const double size = std::array{0.0, 0.1, 1.0, 100.0}[random.below(4)];
  const bool as_a_whole = random.below(2) == 0;
  const auto step = [&] {
    const double way = random.between(-1, 1);
    return size * (seed % 2 == 1 ? std::round(4 * way) / 4 : way);
  };
  const auto drift = [&] {
    Vector3d by;
    for (double& coordinate : by) coordinate = step();
    return by;
  };
  const Vector3d whole = drift();
  Positions end = start.positions;
  for (Vector3d& position : end) position += as_a_whole ? whole : drift();
  return {start, end};
}

/// As one impact in each line.
std::vector<std::tuple<ContactKind, Feature, Feature, double, double, ImpactStatus>> rows_of(
    const std::vector<Impact>& impacts) {
  std::vector<std::tuple<ContactKind, Feature, Feature, double, double, ImpactStatus>> rows;
  for (const Impact& impact : impacts)
    rows.emplace_back(impact.kind, impact.feature_a, impact.feature_b, impact.lower, impact.upper,
                      impact.status);
  return rows;
}

/// A sheet of quads over the unit square at z = 0.
Shape sheet(std::uint32_t cells) {
  Shape shape;
  const std::uint32_t row = cells + 1;
  for (std::uint32_t y = 0; y <= cells; ++y)
    for (std::uint32_t x = 0; x <= cells; ++x)
      shape.positions.emplace_back(double(x) / cells, double(y) / cells, 0);
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x)
      shape.faces.push_back({y * row + x, y * row + x + 1, (y + 1) * row + x + 1, (y + 1) * row + x});
  return shape;
}

Positions moved_by(Positions positions, const Vector3d& by) {
  for (Vector3d& position : positions) position += by;
  return positions;
}

TEST_CASE("A sweep finds what each feature tested with each other one finds") {
  std::size_t impacts = 0;
  std::size_t at_start = 0;
  for (std::uint64_t seed = 0; seed < repeats(80); ++seed) {
    CAPTURE(seed);
    const MovingShape a = random_motion(2 * seed + seed % 2, 40, 25);
    const MovingShape b = random_motion(2 * seed + seed % 2 + 10000, 30, 20);
    const SweepAnswer answer = swept(a, b, {});
    const BruteForce expected(a, b, false);
    REQUIRE(answer.complete);
    REQUIRE(rows_of(answer.impacts) == rows_of(expected.impacts));
    CHECK(answer.time_of_impact == (answer.impacts.empty() ? 1.0 : answer.impacts.front().lower));
    impacts += answer.impacts.size();
    at_start += static_cast<std::size_t>(
        std::count_if(answer.impacts.begin(), answer.impacts.end(),
                      [](const Impact& impact) { return impact.status == ImpactStatus::at_start; }));
  }
  CHECK(impacts > 100);
  CHECK(at_start > 0);
}

TEST_CASE("A sweep of a surface with itself leaves out features that share a vertex, and names pairs once") {
  std::size_t impacts = 0;
  for (std::uint64_t seed = 0; seed < repeats(40); ++seed) {
    CAPTURE(seed);
    const MovingShape shape = random_motion(seed, 60, 30);
    const SweepAnswer answer = swept_with_itself(shape);
    const BruteForce expected(shape, shape, true);
    REQUIRE(rows_of(answer.impacts) == rows_of(expected.impacts));
    impacts += answer.impacts.size();
  }
  CHECK(impacts > 100);
}

TEST_CASE("What passes a thin sheet at a hundred times its own size is found") {
  const Shape wall = sheet(12);
  const MovingShape still(wall, wall.positions);
  Random random(5);
  for (std::uint64_t round = 0; round < repeats(100); ++round) {
    const double x = random.between(0.1, 0.9);
    const double y = random.between(0.1, 0.9);
    const Shape dart = box({x - 0.005, y - 0.005, 0.5}, {0.01, 0.01, 0.01});
    const MovingShape fast(dart, moved_by(dart.positions, {0.01, -0.02, -1.0}));
    const SweepAnswer answer = swept(still, fast, {});
    REQUIRE(!answer.impacts.empty());
    // The lower side comes first, half of the way down.
    CHECK(answer.time_of_impact == Approx(0.5).margin(1e-5));
    CHECK(answer.time_of_impact <= 0.5);
  }
}

TEST_CASE("Surfaces that fly side by side test few regions") {
  const Shape wall = sheet(30);
  const Vector3d far(100, 0, 0);
  const MovingShape lower(wall, moved_by(wall.positions, far));
  Shape above = wall;
  for (Vector3d& position : above.positions) position.z() += 0.1;
  const MovingShape upper(above, moved_by(above.positions, far));
  PairSweep sweep;
  SweepAnswer answer;
  SweepWork work;
  sweep.sweep(lower.way(), upper.way(), {}, answer, work);
  CHECK(answer.impacts.empty());
  CHECK(work.region_pairs_tested == 1);
}

TEST_CASE("The time at which surfaces come within a gap is not too late, and is found without an impact") {
  const Shape wall = sheet(6);
  const MovingShape still(wall, wall.positions);
  const Shape dart = box({0.4, 0.4, 1}, {0.1, 0.1, 0.1});
  SweepQuery query;
  query.gap = 0.25;
  const SweepAnswer passes = swept(still, {dart, moved_by(dart.positions, {0, 0, -2})}, query);
  CHECK(passes.time_of_gap <= 0.375);
  CHECK(passes.time_of_gap > 0.37);
  CHECK(passes.time_of_impact == Approx(0.5).margin(1e-5));
  const SweepAnswer comes_near = swept(still, {dart, moved_by(dart.positions, {0, 0, -0.8})}, query);
  CHECK(comes_near.impacts.empty());
  CHECK(comes_near.time_of_impact == 1);
  CHECK(comes_near.time_of_gap <= 0.9375);
  CHECK(comes_near.time_of_gap > 0.93);
  CHECK(comes_near.met());
  const SweepAnswer stays_away = swept(still, {dart, moved_by(dart.positions, {0, 0, -0.7})}, query);
  CHECK(stays_away.time_of_gap == 1);
  CHECK_FALSE(stays_away.met());
}

TEST_CASE("Of a sweep with a limit the earliest impacts are kept") {
  const MovingShape a = random_motion(6, 60, 40);
  const MovingShape b = random_motion(10006, 40, 30);
  const std::vector<Impact> all = swept(a, b, {}).impacts;
  REQUIRE(all.size() > 5);
  SweepQuery query;
  query.impact_limit = 5;
  const SweepAnswer answer = swept(a, b, query);
  CHECK(rows_of(answer.impacts) == rows_of({all.begin(), all.begin() + 5}));
  CHECK(answer.left_out == all.size() - 5);
}

TEST_CASE("A sweep that may not test enough regions is not complete, and says that nothing is known") {
  const MovingShape a = random_motion(6, 60, 40);
  const MovingShape b = random_motion(10006, 40, 30);
  SweepQuery query;
  query.work_limit = 2;
  const SweepAnswer answer = swept(a, b, query);
  CHECK_FALSE(answer.complete);
  CHECK(answer.impacts.empty());
  CHECK(answer.time_of_impact == 0);
  CHECK(answer.time_of_gap == 0);
  CHECK(answer.met());
}

}  // namespace
}  // namespace graze::tests
