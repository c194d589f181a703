// The oracle of pairs of edges against answers known by hand, and its random surfaces.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/catch.hpp"
#include "support/edge_comparison.hpp"
#include "support/oracle/oracle_edges.hpp"
#include "support/random/random_creases.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Creases;
using oracle::EdgePair;
using oracle::Shape;

/// A closed box about the origin, of six quads or twelve triangles.
Shape crate(const Vector3d& half, bool has_quads) {
  Shape shape;
  for (unsigned i = 0; i < 8; ++i)
    shape.positions.emplace_back((i & 1U) != 0 ? half.x() : -half.x(), (i & 2U) != 0 ? half.y() : -half.y(),
                                 (i & 4U) != 0 ? half.z() : -half.z());
  const std::vector<std::vector<std::uint32_t>> quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  if (has_quads) {
    shape.faces = quads;
    return shape;
  }
  for (const auto& quad : quads) {
    shape.faces.push_back({quad[0], quad[1], quad[2]});
    shape.faces.push_back({quad[0], quad[2], quad[3]});
  }
  return shape;
}

Shape lifted(Shape shape, double height) {
  for (Vector3d& position : shape.positions) position.z() += height;
  return shape;
}

std::size_t crease_count(const Shape& shape) {
  const auto creases = oracle::creases_of(shape);
  return static_cast<std::size_t>(std::count(creases.begin(), creases.end(), true));
}

/// Two triangles that share edge 0 along x. The corners are to either side of it, at these heights.
Shape hinge(double height_before, double height_behind) {
  return {{{-1, 0, 0}, {1, 0, 0}, {0, -1, height_before}, {0, 1, height_behind}}, {{0, 1, 3}, {1, 0, 2}}};
}

/// A triangle with edge 0 along y over or below the origin, and a corner far away.
Shape bar(double height, double corner) {
  return {{{0, -1, height}, {0, 1, height}, {0, 0, corner}}, {{0, 1, 2}}};
}

/// The pair of the two first edges.
EdgePair first_pair(const Shape& a, const Shape& b, const Shape& rest_a) {
  const auto pairs = edge_pairs_of(a, b, 10, Creases(rest_a, b));
  const auto found = std::find_if(pairs.begin(), pairs.end(), [](const EdgePair& pair) {
    return pair.a.index == 0 && pair.b.index == 0;
  });
  REQUIRE(found != pairs.end());
  return *found;
}
EdgePair first_pair(const Shape& a, const Shape& b) {
  return first_pair(a, b, a);
}

/// The pairs listed between faces that are level, with how far b is sunk.
std::vector<EdgePair> upright_pairs(const Shape& a, const Shape& b, const Creases& creases) {
  std::vector<EdgePair> found;
  for (const EdgePair& pair : edge_pairs_of(a, b, 0.02, creases)) {
    const oracle::Point gap = pair.contact.b.point - pair.contact.a.point;
    const oracle::Rational up = (pair.is_sunk ? -1 : 1) * gap.z;
    if (pair.is_listed() && up > 0 && up * up > pair.contact.a.distance_squared * 81 / 100)
      found.push_back(pair);
  }
  return found;
}

}  // namespace

TEST_CASE("oracle of edges: the edges of a box are creases, diagonals of its sides are not") {
  CHECK(crease_count(crate({1, 2, 3}, true)) == 12);
  const Shape triangles = crate({1, 2, 3}, false);
  CHECK(oracle::edges_of(triangles).size() == 18);
  CHECK(crease_count(triangles) == 12);
}

TEST_CASE("oracle of edges: borders, edges of three faces and turned faces are creases") {
  const Shape flat = hinge(0, 0);
  CHECK(crease_count(flat) == 4);
  CHECK_FALSE(oracle::creases_of(flat)[0]);
  Shape pages = flat;
  pages.positions.emplace_back(0, 0, 1);
  pages.faces.push_back({0, 1, 4});
  CHECK(oracle::creases_of(pages)[0]);
  Shape turned = flat;
  turned.faces[1] = {0, 1, 2};  // both faces pass the edge in one direction, so that normals are opposite
  CHECK(oracle::creases_of(turned)[0]);
  // A face that passes an edge twice has it once.
  Shape twice = flat;
  twice.faces[1] = {1, 0, 1};
  CHECK_FALSE(oracle::creases_of(twice)[0]);
}

TEST_CASE("oracle of edges: a crease bends by more than 5.07 degrees at rest") {
  CHECK_FALSE(oracle::creases_of(hinge(0, std::tan(5.06 * std::numbers::pi / 180)))[0]);
  CHECK(oracle::creases_of(hinge(0, std::tan(5.08 * std::numbers::pi / 180)))[0]);
  CHECK(oracle::creases_of(hinge(0, -std::tan(5.08 * std::numbers::pi / 180)))[0]);
  CHECK(oracle::creases_of(hinge(3, 3))[0]);  // folded by more than a right angle
}

TEST_CASE("oracle of edges: triangles of no area make no crease") {
  // Corner 2 is on the edge.
  const Shape flat{{{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}}, {{0, 1, 3}, {1, 0, 2}}};
  CHECK_FALSE(oracle::creases_of(flat)[0]);
}

TEST_CASE("oracle of edges: of a quad the triangle that has the edge counts") {
  // Flat beside edge 0, with the far corner raised, of a quad split from its first corner.
  const auto creases_beside = [](const std::vector<std::uint32_t>& quad) {
    const Shape shape{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, -1, 0}}, {{1, 0, 4}, quad}};
    return bool(oracle::creases_of(shape)[0]);
  };
  CHECK_FALSE(creases_beside({0, 1, 2, 3}));
  CHECK(creases_beside({1, 2, 3, 0}));
}

TEST_CASE("oracle of edges: a valley is listed up to 10.2 degrees, where it is a crease") {
  const Shape deep = hinge(1, 1);
  for (const double degrees : {0.5, 10.1, 10.3, 30.0}) {
    const double height = std::tan(degrees * std::numbers::pi / 180);
    const EdgePair pair = first_pair(hinge(height, height), bar(0.5, 30), deep);
    INFO(degrees << " degrees");
    CHECK_FALSE(pair.is_locally_closest);
    CHECK(pair.bounds_patch == (degrees < 10.2));
    const EdgePair one_side = first_pair(hinge(-1, height), bar(0.5, 30), deep);
    CHECK(one_side.bounds_patch == (degrees < 10.2));
    CHECK_FALSE(first_pair(hinge(height, height), bar(0.5, 30), hinge(0, 0)).bounds_patch);
  }
  CHECK(first_pair(hinge(-1, -1), bar(0.5, 30)).is_locally_closest);
  // The bar's own triangle hangs below it.
  CHECK(first_pair(hinge(-1, -1), bar(0.5, -30)).is_listed() == false);
}

TEST_CASE("oracle of edges: both sides back are sunk only where one of the edges pierces") {
  // A roof with its normals above, and below its ridge the edge of a wedge that stands upside down.
  const Shape roof = hinge(-1, -1);
  Shape wedge{{{0, -1.5, -0.25}, {0, 1.5, -0.25}, {-30, 0, 4}, {30, 0, 4}}, {{1, 0, 2}, {0, 1, 3}}};
  const EdgePair sunk = first_pair(roof, wedge);
  CHECK(sunk.side_a == Side::back);
  CHECK(sunk.side_b == Side::back);
  CHECK(sunk.is_sunk);
  CHECK(sunk.bounds_patch);
  CHECK_FALSE(sunk.is_locally_closest);
  // Without the ends that pierce it is only behind.
  wedge.positions[0].y() = -0.2;
  wedge.positions[1].y() = 0.2;
  const EdgePair behind = first_pair(roof, wedge);
  CHECK(behind.side_a == Side::back);
  CHECK(behind.side_b == Side::back);
  CHECK_FALSE(behind.is_sunk);
  CHECK_FALSE(behind.bounds_patch);
}

TEST_CASE("oracle of edges: edges that cross are locally closest and not sunk") {
  const EdgePair pair = first_pair(hinge(-1, -1), bar(0, 30));
  CHECK(pair.contact.a.distance_squared == 0);
  CHECK(pair.is_locally_closest);
  CHECK_FALSE(pair.is_sunk);
  CHECK(pair.side_a == Side::none);
  CHECK_FALSE(pair.bounds_patch);
}

TEST_CASE("oracle of edges: outlines of boxes that cross are listed above and below each other, tilted too") {
  struct Placement {
    Vector3d half;
    double yaw;
    std::size_t crossings;
  };
  for (const Placement& placement :
       {Placement{{0.25, 0.25, 0.25}, 0.047, 8}, {{0.25, 0.25, 0.25}, 0.785, 8}, {{0.6, 0.12, 0.05}, 1.5, 4}})
    for (const bool has_quads : {false, true}) {
      const Shape lower = crate(placement.half, has_quads);
      const Creases creases(lower, lower);
      const Shape turned = oracle::turned_about(lower, {0, 0, 1}, placement.yaw);
      for (const double tilt : {0.0, 1e-6, 1e-3})
        for (const double gap : {0.005, -0.001, -0.01}) {
          const Shape upper =
              lifted(oracle::turned_about(turned, {1, 0.6, 0}, tilt), 2 * placement.half.z() + gap);
          const auto pairs = upright_pairs(lower, upper, creases);
          INFO("yaw " << placement.yaw << ", tilt " << tilt << ", gap " << gap);
          CHECK(pairs.size() == placement.crossings);
          for (const EdgePair& pair : pairs) CHECK(pair.is_sunk == (gap < 0));
        }
    }
}

TEST_CASE("oracle of edges: a triangle whose face is not looked at does not bound the cone") {
  const Shape valley = hinge(1, -1);  // the face before the edge leads up to the bar
  const Shape over = bar(0.5, 30);
  CHECK_FALSE(first_pair(valley, over).is_listed());
  const oracle::ExactShape a(valley);
  const oracle::ExactShape b(over);
  for (const std::uint32_t hidden : {0U, 1U}) {
    const oracle::FacePairs pairs(valley, over,
                                  [&](std::uint32_t face_a, std::uint32_t) { return face_a != hidden; });
    const auto found = oracle::EdgeOracle(a, b, pairs).pairs_within(oracle::Limit::none(), {valley, over});
    const auto first = std::find_if(found.begin(), found.end(), [](const EdgePair& pair) {
      return pair.a.index == 0 && pair.b.index == 0;
    });
    REQUIRE(first != found.end());
    CHECK(first->is_listed() == (hidden == 1));
  }
}

TEST_CASE("oracle of edges: random surfaces reach every case of the rule") {
  EdgeTally tally;
  std::size_t by_lie[oracle::lie_count] = {};
  std::array<std::size_t, 3> by_face_count{};
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const oracle::CreaseScene scene = oracle::random_creases(seed);
    const auto pairs = edge_pairs_of(scene.a, scene.b, scene.threshold, Creases(scene.rest_a, scene.rest_b));
    tally.count(pairs);
    by_lie[static_cast<std::size_t>(scene.lie)] += pairs.size();
    const oracle::ExactShape rest(scene.rest_a);
    const oracle::EdgeSurroundings around(rest);
    for (std::uint32_t edge = 0; edge < rest.edge_count; ++edge)
      ++by_face_count[std::min<std::size_t>(around.faces(edge).size(), 3) - 1];
  }
  for (const std::size_t count : by_lie) CHECK(count > 50);
  for (const std::size_t count : by_face_count) CHECK(count > 5);
  CHECK(tally.patches_only > 100);
  CHECK(tally.sunk > 100);
  CHECK(tally.sunk_and_listed > 10);
  CHECK(tally.behind_only > 10);
  tally.print("random surfaces");
}

}  // namespace graze::tests
