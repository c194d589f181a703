// The oracles against answers known by hand.

#include <Eigen/Geometry>
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "support/catch.hpp"
#include "support/exact/exact.hpp"
#include "support/oracle/oracle.hpp"
#include "support/random/random_scenes.hpp"

using namespace graze;
using namespace graze::oracle;
using Eigen::Vector3d;

namespace {

std::string text(Feature feature) {
  return "vef"[static_cast<int>(feature.kind)] + std::to_string(feature.index);
}

/// "VF v0 f1" for each contact, with " through" for a piercing.
std::vector<std::string> names(const std::vector<Named>& contacts) {
  static const std::array<std::string, 6> kinds = {"VV", "VE", "VF", "EE", "EF", "FF"};
  std::vector<std::string> result;
  for (const Named& contact : contacts) {
    result.push_back(kinds[static_cast<std::size_t>(contact.kind)] + " " + text(contact.a) + " " +
                     text(contact.b) + (contact.pierced ? " through" : ""));
  }
  return result;
}

std::string name(const std::optional<Named>& contact) {
  return contact ? names({*contact})[0] : "none";
}

using Names = std::vector<std::string>;

Shape triangle(Vector3d p, Vector3d q, Vector3d r) {
  return {{p, q, r}, {{0, 1, 2}}};
}
Shape quad(Vector3d p, Vector3d q, Vector3d r, Vector3d s) {
  return {{p, q, r, s}, {{0, 1, 2, 3}}};
}
Shape floor_quad(double half) {
  return quad({-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0});
}

Shape box(Vector3d low, Vector3d size) {
  Shape shape;
  for (unsigned i = 0; i < 8; ++i)
    shape.positions.emplace_back(low + size.cwiseProduct(Vector3d(i & 1U, (i >> 1U) & 1U, i >> 2U)));
  shape.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return shape;
}

/// A needle: its tip is vertex 0, the rest far off in the direction `away`.
Shape needle(Vector3d tip, Vector3d away) {
  const Vector3d side = away.unitOrthogonal() * 0.01;
  return triangle(tip, tip + 10 * away + side, tip + 10 * away - side);
}

/// Like a roof: ridge from (0, -1, 0) to (0, 1, 0), the slopes falling to both sides. The ridge is the inner
/// diagonal.
Shape roof() {
  return quad({0, -1, 0}, {1, 0, -1}, {0, 1, 0}, {-1, 0, -1});
}

/// A bar: a thin triangle whose edge 0 runs from p to q and whose third corner lies far up.
Shape bar(Vector3d p, Vector3d q) {
  return triangle(p, q, (p + q) / 2 + Vector3d(0, 0, 20));
}

}  // namespace

TEST_CASE("oracle: roots and rationals round to the nearest double, down and up") {
  CHECK(round_sqrt(4) == 2);
  CHECK(round_sqrt(2) == std::sqrt(2.0));
  CHECK(round_sqrt(2, Rounding::down) < round_sqrt(2, Rounding::up));
  CHECK(std::nextafter(round_sqrt(2, Rounding::down), 2) == round_sqrt(2, Rounding::up));
  CHECK(round_sqrt(Rational(9, 16), Rounding::up) == 0.75);
  CHECK(round(Rational(1, 3)) == 1.0 / 3.0);
  CHECK(round(Rational(-1, 3)) == -1.0 / 3.0);
  CHECK(round(Rational(-1, 3), Rounding::up) > round(Rational(-1, 3), Rounding::down));
  const Rational tie = Rational(1) + Rational(DBL_EPSILON) / 2;
  CHECK(round(tie) == 1);
  CHECK(round(tie, Rounding::up) == 1 + DBL_EPSILON);
  CHECK(round(Rational(tie + Rational(DBL_EPSILON))) == 1 + 2 * DBL_EPSILON);
  const double least = std::numeric_limits<double>::denorm_min();
  CHECK(round(Rational(Rational(least) * 3 / 4)) == least);
  CHECK(round_sqrt(Rational(Rational(least) * Rational(least))) == least);
  CHECK(round_sqrt(Rational(Rational(least) * least / 9), Rounding::down) == 0);
  CHECK(round_sqrt(Rational(Rational(least) * least / 9), Rounding::up) == least);
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const double mantissa = random.between(0, 1);
    const double value = std::ldexp(mantissa, static_cast<int>(random.below(200)) - 100);
    CHECK(round(Rational(value)) == value);
    CHECK(round_sqrt(Rational(value)) == std::sqrt(value));
  }
}

TEST_CASE("oracle: edges are numbered along the faces, lower vertex first") {
  const Shape shape{std::vector<Vector3d>(5, Vector3d::Zero()), {{2, 1, 0}, {0, 1, 4, 4}, {3, 3, 3}}};
  using Edges = std::vector<std::array<std::uint32_t, 2>>;
  CHECK(edges_of(shape) == Edges{{1, 2}, {0, 1}, {0, 2}, {1, 4}, {0, 4}});
}

TEST_CASE("oracle: a needle over a vertex, an edge, a face and a quad's diagonal") {
  const Shape sheet = floor_quad(1);
  const auto below = [&](double x, double y) {
    return features(needle({x, y, 0.5}, {0, 0, 1}), sheet, 0.75);
  };
  CHECK(names(below(-3, -1)).empty());
  CHECK(names(below(-1.25, -1.25)) == Names{"VV v0 v0"});
  CHECK(names(below(-1.25, -1)) == Names{"VV v0 v0"});
  CHECK(names(below(0.25, -1.25)) == Names{"VE v0 e0"});
  CHECK(names(below(0.25, -1)) == Names{"VE v0 e0"});
  CHECK(names(below(0.5, 0.25)) == Names{"VE v0 e1", "VF v0 f0"});
  CHECK(names(below(0.25, 0.25)) == Names{"VF v0 f0"});
  CHECK(below(0.25, 0.25)[0].distance == 0.5);
  CHECK(below(0.25, 0.25)[0].point_b == Vector3d(0.25, 0.25, 0));
  CHECK(names(features(sheet, needle({0, 0, 0.5}, {0, 0, 1}), 1)) == Names{"VF f0 v0"});
}

TEST_CASE(
    "oracle: a vertex over the edge between two faces is one contact, and so is one over their corner") {
  const Shape fan{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                  {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  CHECK(names(features(needle({0, 0.5, 0.25}, {0, 0, 1}), fan, 0.3)) == Names{"VE v0 e2"});
  CHECK(names(features(needle({0, 0, 0.25}, {0, 0, 1}), fan, 0.26)) == Names{"VV v0 v0"});
}

TEST_CASE("oracle: strictly below the threshold counts") {
  const Shape sheet = floor_quad(1);
  const Shape tip = needle({0.5, 0.25, 0.5}, {0, 0, 1});
  CHECK(features(tip, sheet, 0.5).empty());
  CHECK(features(tip, sheet, std::nextafter(0.5, 1.0)).size() == 1);
  CHECK(closest(tip, sheet, 0.5) == std::nullopt);
  CHECK(name(closest(tip, sheet, std::nextafter(0.5, 1.0))) == "VF v0 f0");
  CHECK(names(vertices(sheet, tip, 1.1)) == Names{"VV v2 v0"});
}

TEST_CASE("oracle: crossing edges one above the other are one EE") {
  const Shape low = triangle({-1, 0, 0}, {1, 0, 0}, {0, 0, -9});
  const Shape high = triangle({0.25, -1, 0.5}, {0.25, 1, 0.5}, {0.25, 0, 9});
  const auto contacts = features(low, high, 0.6);
  CHECK(names(contacts) == Names{"EE e0 e0"});
  CHECK(contacts[0].distance == 0.5);
  CHECK(contacts[0].point_a == Vector3d(0.25, 0, 0));
  CHECK(contacts[0].point_b == Vector3d(0.25, 0, 0.5));
  CHECK(name(closest(low, high, 0.6)) == "EE e0 e0");
}

TEST_CASE("oracle: parallel edges are named by the ends of their common stretch, in closest by its middle") {
  const Shape low = triangle({0, 0, 0}, {4, 0, 0}, {2, 0, -9});
  const Shape partly = triangle({1, 0, 1}, {6, 0, 1}, {3, 0, 9});
  CHECK(names(features(low, partly, 1.01)) == Names{"VE v1 e0", "VE e0 v0"});
  const auto middle = closest(low, partly, 2);
  CHECK(name(middle) == "EE e0 e0");
  CHECK(middle->point_a == Vector3d(2.5, 0, 0));
  CHECK(middle->point_b == Vector3d(2.5, 0, 1));

  const Shape same = triangle({4, 0, 1}, {0, 0, 1}, {2, 0, 9});
  CHECK(names(features(low, same, 1.01)) == Names{"VV v0 v1", "VV v1 v0"});
  const Shape end_to_end = triangle({4, 0, 1}, {6, 0, 1}, {5, 0, 9});
  CHECK(names(features(low, end_to_end, 1.01)) == Names{"VV v1 v0"});
  CHECK(name(closest(low, end_to_end, 2)) == "VV v1 v0");
  const Shape beyond = triangle({5, 0, 0}, {6, 0, 0}, {5, 0, 9});
  CHECK(names(features(low, beyond, 1.01)) == Names{"VV v1 v0"});
}

TEST_CASE("oracle: an edge through a face is EF at every threshold") {
  const Shape sheet = floor_quad(2);
  const Shape through = triangle({0.5, 0.25, -1}, {0.5, 0.25, 1}, {0.75, 0.25, 9});
  const auto contacts = features(through, sheet, 0);
  CHECK(names(contacts) == Names{"EF e0 f0 through", "EF e2 f0 through"});
  CHECK(contacts[0].point_a == Vector3d(0.5, 0.25, 0));
  CHECK(contacts[0].distance == 0);
  CHECK(names(features(sheet, through, 0)) == Names{"EF f0 e0 through", "EF f0 e2 through"});
  CHECK(surface_distance(sheet, through).pierced);
  CHECK(surface_distance(sheet, through).distance_up == 0);
  CHECK(name(closest(sheet, through, 0)) == "EF f0 e0 through");

  const Shape on_diagonal = triangle({0.5, 0.5, -1}, {0.5, 0.5, 1}, {0.5, 0.5, 9});
  CHECK(names(features(on_diagonal, sheet, 0)) == Names{"EF e0 f0 through", "EF e2 f0 through"});
}

TEST_CASE("oracle: an edge that crosses at the border or ends on the face does not pierce it") {
  const Shape sheet = floor_quad(2);
  const Shape at_border = triangle({2, 0.25, -1}, {2, 0.25, 1}, {9, 0.25, 0});
  CHECK(features(at_border, sheet, 0).empty());
  CHECK(names(features(at_border, sheet, 0.01)) == Names{"EE e0 e1"});
  const Shape at_corner = triangle({2, 2, -1}, {2, 2, 1}, {9, 9, 0});
  CHECK(names(features(at_corner, sheet, 0.01)) == Names{"VE e0 v2"});
  const Shape ending = needle({0.5, 0.25, 0}, {0, 0, 1});
  CHECK(features(ending, sheet, 0).empty());
  CHECK(names(features(ending, sheet, 0.01)) == Names{"VF v0 f0"});
  CHECK_FALSE(surface_distance(ending, sheet).pierced);
}

TEST_CASE("oracle: a warped quad pierced twice is one contact, nearer the edge's lower vertex") {
  const Shape across = bar({-1, 0, -0.25}, {1, 0, -0.25});
  const auto contacts = features(across, roof(), 0);
  CHECK(names(contacts) == Names{"EF e0 f0 through"});
  CHECK(contacts[0].point_a == Vector3d(-0.25, 0, -0.25));
  Shape turned = across;
  std::swap(turned.positions[0], turned.positions[1]);
  CHECK(features(turned, roof(), 0)[0].point_a == Vector3d(0.25, 0, -0.25));
}

TEST_CASE("oracle: an edge over a fold is EF, a fold over a fold FF") {
  const auto edge_contacts = features(bar({-1, 0.25, 0.5}, {1, 0.25, 0.5}), roof(), 0.6);
  CHECK(names(edge_contacts) == Names{"EF e0 f0"});
  CHECK(edge_contacts[0].distance == 0.5);
  CHECK(edge_contacts[0].point_b == Vector3d(0, 0.25, 0));
  CHECK(name(closest(roof(), bar({-1, 0.25, 0.5}, {1, 0.25, 0.5}), 0.6)) == "EF f0 e0");

  // A valley whose fold runs along x, half a unit above the ridge.
  const Shape valley = quad({-1, 0, 0.5}, {0, -1, 1.5}, {1, 0, 0.5}, {0, 1, 1.5});
  const auto fold_contacts = features(roof(), valley, 0.6);
  CHECK(names(fold_contacts) == Names{"FF f0 f0"});
  CHECK(fold_contacts[0].distance == 0.5);
  CHECK(name(closest(roof(), valley, 0.6)) == "FF f0 f0");
  CHECK(name(closest(roof(), valley, 0.5)) == "none");

  // A triangle's border above the ridge, parallel to it, is not unique: the ends name it.
  CHECK(names(features(bar({0, -0.5, 0.25}, {0, 0.5, 0.25}), roof(), 0.3)) == Names{"VF v0 f0", "VF v1 f0"});
}

TEST_CASE("oracle: a fold through a face is FF at distance 0 below the threshold, no piercing") {
  // Only the ridge reaches above the plane z = -0.25 inside the slit triangle.
  const Shape slit = triangle({0, 0.5, -3}, {3, 0.5, 3}, {-3, 0.5, 3});
  const auto contacts = features(roof(), slit, 0.01);
  CHECK(std::ranges::count(names(contacts), std::string("FF f0 f0")) == 1);
  for (const Named& contact : features(roof(), slit, 0)) CHECK(contact.kind == ContactKind::EF);
  const Named& fold = contacts.back();
  CHECK(fold.kind == ContactKind::FF);
  CHECK(fold.distance == 0);
  CHECK_FALSE(fold.pierced);
  CHECK(fold.point_a == Vector3d(0, 0.5, 0));
}

TEST_CASE("oracle: a flat quad's diagonal has no contact of its own") {
  const Shape sheet = quad({0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0});
  CHECK(names(features(bar({-3, 0.25, 0.5}, {3, 0.25, 0.5}), sheet, 0.55)) == Names{"EE e0 e1", "EE e0 e2"});
  const auto middle = closest(bar({-3, 0.25, 0.5}, {3, 0.25, 0.5}), sheet, 0.6);
  CHECK(name(middle) == "EF e0 f0");
  CHECK(middle->point_b == Vector3d(0, 0.25, 0));
}

TEST_CASE("oracle: a degenerate face is what is there") {
  const Shape collinear = triangle({-1, 0, 0}, {1, 0, 0}, {0, 0, 0});
  CHECK(names(features(needle({0.5, 0, 0.25}, {0, 0, 1}), collinear, 0.3)) == Names{"VE v0 e0", "VE v0 e1"});
  CHECK(names(features(needle({0, 0, 0.25}, {0, 0, 1}), collinear, 0.26)) == Names{"VV v0 v2", "VE v0 e0"});
  CHECK(name(closest(needle({0.5, 0, 0.25}, {0, 0, 1}), collinear, 0.3)) == "VE v0 e0");

  const Shape point = triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  CHECK(names(features(needle({0, 0, 0.25}, {0, 0, 1}), point, 0.26)) ==
        Names{"VV v0 v0", "VV v0 v1", "VV v0 v2"});
  CHECK(name(closest(needle({0, 0, 0.25}, {0, 0, 1}), point, 0.26)) == "VV v0 v0");

  const Shape repeated{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}};
  CHECK(names(features(needle({0.5, 0, 0.25}, {0, 0, 1}), repeated, 0.3)) == Names{"VE v0 e0"});

  const Shape wall = triangle({0.25, -9, -9}, {0.25, 9, -9}, {0.25, 0, 9});
  CHECK(names(features(collinear, wall, 0)) == Names{"EF e0 f0 through", "EF e1 f0 through"});
  const Shape stake = bar({0.5, 0.5, 0.5}, {0.5, -0.5, -0.5});
  CHECK_FALSE(surface_distance(collinear, stake).pierced);
  CHECK(surface_distance(collinear, stake).distance_squared == 0);
  CHECK(names(features(collinear, stake, 0.01)) == Names{"EE e0 e0", "EE e1 e0"});
}

TEST_CASE("oracle: a vertex that no face uses is not there") {
  Shape sheet = floor_quad(1);
  sheet.positions.emplace_back(NAN, NAN, NAN);
  const Shape tip = needle({0.5, 0.25, 0.5}, {0, 0, 1});
  CHECK(names(features(sheet, tip, 0.6)) == Names{"VF f0 v0"});
  CHECK(vertices(sheet, tip, 100).size() == 12);
  CHECK(regions_of(sheet)[0].vertices == std::vector<std::uint32_t>{0, 1, 2, 3});
}

TEST_CASE("oracle: a box on a table is FF, its corners and edges are in features") {
  const Shape table = floor_quad(8);
  const Shape cube = box({0, 1, 0.25}, {2, 4, 2});
  const auto resting = closest(cube, table, 0.5);
  CHECK(name(resting) == "FF f0 f0");
  CHECK(resting->point_a == Vector3d(1, 3, 0.25));
  CHECK(resting->point_b == Vector3d(1, 3, 0));
  CHECK(names(features(cube, table, 0.5)) == Names{"VF v0 f0", "VF v1 f0", "VF v2 f0", "VF v3 f0"});
  CHECK(surface_distance(cube, table).distance_squared == Rational(1, 16));

  const Shape on_it = box({0, 1, 0}, {2, 4, 2});
  CHECK(name(closest(on_it, table, 0.5)) == "FF f0 f0");
  CHECK(name(closest(on_it, table, 0)) == "none");
}

TEST_CASE("oracle: faces over each other give the centroid of their overlap") {
  const auto corner = closest(box({1, 1, 1}, {4, 4, 1}), box({3, 2, 0}, {4, 4, 0.5}), 1);
  CHECK(name(corner) == "FF f0 f1");
  CHECK(corner->point_a == Vector3d(4, 3.5, 1));
  CHECK(corner->point_b == Vector3d(4, 3.5, 0.5));
  CHECK(corner->distance == 0.5);
}

TEST_CASE("oracle: a box on its edge is EF, side by side with another EE, corner to corner VV") {
  const Shape table = floor_quad(8);
  const Shape prism{{{-1, -1, 0.5}, {-1, 1, 0.5}, {0, -1, 2}, {0, 1, 2}, {-2, -1, 2}, {-2, 1, 2}},
                    {{0, 2, 3, 1}, {0, 1, 5, 4}, {2, 4, 5, 3}, {0, 4, 2}, {1, 3, 5}}};
  const auto resting = closest(prism, table, 1);
  CHECK(name(resting) == "EF e3 f0");
  CHECK(resting->point_a == Vector3d(-1, 0, 0.5));
  const auto leaning = closest(box({0, 0, 0}, {1, 2, 1}), box({1.5, 0, 1.5}, {1, 2, 1}), 1);
  CHECK(leaning->kind == ContactKind::EE);
  CHECK(leaning->point_a == Vector3d(1, 1, 1));
  CHECK(leaning->distance_squared == Rational(1, 2));
  CHECK(name(closest(box({0, 0, 0}, {1, 1, 1}), box({2, 2, 2}, {1, 1, 1}), 2)) == "VV v7 v0");
}

TEST_CASE("oracle: exact ties go to the smallest kind and features") {
  // Two feet at the same height over the floor, and two floors under one foot.
  const Shape feet{{{1, 1, 1}, {1, 2, 9}, {2, 1, 9}, {-1, -1, 1}, {-1, -2, 9}, {-2, -1, 9}},
                   {{3, 4, 5}, {0, 1, 2}}};
  CHECK(name(closest(feet, floor_quad(8), 2)) == "VF v0 f0");
  Shape floors = floor_quad(8);
  floors.faces = {{0, 1, 2, 3}, {0, 1, 2, 3}};
  CHECK(name(closest(needle({1, 2, 1}, {0, 0, 1}), floors, 2)) == "VF v0 f0");
  CHECK(names(features(needle({1, 2, 1}, {0, 0, 1}), floors, 2)) == Names{"VF v0 f0", "VF v0 f1"});
}

TEST_CASE("oracle: the same surface twice is at distance 0") {
  const Shape cube = box({0, 0, 0}, {1, 1, 1});
  CHECK(surface_distance(cube, cube).distance_squared == 0);
  CHECK_FALSE(surface_distance(cube, cube).pierced);
  CHECK(name(closest(cube, cube, 1)) == "FF f0 f0");
  CHECK(names(features(cube, cube, 0)).empty());
  CHECK(vertices(cube, cube, 1).size() == 8);
}

TEST_CASE("oracle: the octree halves the root box and keeps cuts on the upper side") {
  // 64 vertices on a grid of 4 x 4 x 4 with coordinates 0 to 3: the cut at 1.5 leaves 8 in each child.
  Shape grid;
  for (int i = 0; i < 64; ++i) grid.positions.emplace_back(i % 4, i / 4 % 4, i / 16);
  for (std::uint32_t i = 0; i < 64; ++i) grid.faces.push_back({i, i, i});
  const auto tree = regions_of(grid);
  REQUIRE(tree.size() == 9);
  CHECK(tree[0].level == 0);
  CHECK_FALSE(tree[0].leaf);
  CHECK(tree[0].middle == 21);
  CHECK(tree[1].vertices == std::vector<std::uint32_t>{0, 1, 4, 5, 16, 17, 20, 21});
  CHECK(tree[1].middle == 0);
  CHECK(tree[1].leaf);
  CHECK(radius(tree[1], grid.positions) == std::sqrt(3.0));
  CHECK(level_radii(tree, grid.positions) == std::vector<double>{std::sqrt(12.0), std::sqrt(3.0)});

  Shape line;  // 0 to 32 along x: the cut at 16 goes up
  for (std::uint32_t i = 0; i <= 32; ++i) {
    line.positions.emplace_back(i, 0, 0);
    line.faces.push_back({i, i, i});
  }
  const auto halves = regions_of(line);
  REQUIRE(halves.size() == 3);
  CHECK(halves[1].vertices.size() == 16);
  CHECK(halves[2].vertices.front() == 16);
  CHECK(halves[0].middle == 16);

  Shape heap = line;  // all in one point but two, which only the deepest level parts
  for (auto& position : heap.positions) position = Vector3d::Zero();
  heap.positions[31].x() = 1;
  heap.positions[32].x() = std::ldexp(1.0, -60);
  const auto deep = regions_of(heap);
  CHECK(deep.back().level == 40);
  CHECK(deep.back().vertices.size() == 32);
  heap.positions[32].x() = 0;
  CHECK(regions_of(heap).back().level == 1);
}

TEST_CASE("oracle: regions gives one vertex pair for each pair of leaves") {
  Shape line;
  for (std::uint32_t i = 0; i <= 32; ++i) {
    line.positions.emplace_back(i, 0, 0);
    line.faces.push_back({i, i, i});
  }
  Shape above = line;
  for (auto& position : above.positions) position.z() = 1;
  CHECK(names(regions(line, above, 1.25, line, above)) == Names{"VV v0 v0", "VV v16 v16"});
  CHECK(names(regions(line, above, 1.5, line, above)) ==
        Names{"VV v0 v0", "VV v15 v16", "VV v16 v15", "VV v16 v16"});
  CHECK(regions(line, above, 1, line, above).empty());
  CHECK(vertices(line, above, 1.25).size() == 33);
  CHECK(vertex_distance(line, above).distance_down == 1);
}

TEST_CASE("oracle: moving, scaling and exchanging the shapes changes nothing else") {
  const auto mapped = [](Shape shape, double scale, const Vector3d& offset) {
    for (auto& position : shape.positions) position = scale * position + offset;
    return shape;
  };
  const auto exchanged = [](std::vector<Named> contacts) {
    for (Named& contact : contacts) std::swap(contact.a, contact.b);
    std::ranges::sort(contacts, {},
                      [](const Named& contact) { return std::tuple(contact.kind, contact.a, contact.b); });
    return contacts;
  };
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed < 401; seed += 2) {  // on a grid, where the moves are exact
    INFO("seed " << seed);
    const auto [a, b, threshold, placement, on_grid] = random_scene(seed);
    const auto expected = features(a, b, threshold);
    compared += expected.size();
    const auto same = [&](const std::vector<Named>& contacts, double scale) {
      REQUIRE(names(contacts) == names(expected));
      for (std::size_t i = 0; i < contacts.size(); ++i)
        CHECK(contacts[i].distance == scale * expected[i].distance);
    };
    const Vector3d far(std::ldexp(1.0, 40), -std::ldexp(1.0, 20), std::ldexp(1.0, 10));
    same(features(mapped(a, 1, far), mapped(b, 1, far), threshold), 1);
    for (const double scale : {std::ldexp(1.0, -600), std::ldexp(1.0, 600)}) {
      const Shape scaled_a = mapped(a, scale, Vector3d::Zero());
      const Shape scaled_b = mapped(b, scale, Vector3d::Zero());
      same(features(scaled_a, scaled_b, scale * threshold), scale);
      CHECK(surface_distance(scaled_a, scaled_b).distance_up == scale * surface_distance(a, b).distance_up);
      CHECK(name(closest(scaled_a, scaled_b, scale * threshold)) == name(closest(a, b, threshold)));
    }
    same(exchanged(features(b, a, threshold)), 1);
    CHECK(surface_distance(b, a).distance_squared == surface_distance(a, b).distance_squared);
  }
  CHECK(compared > 500);
}

TEST_CASE("oracle: random scenes reach every case, and the oracles agree with each other") {
  Coverage coverage;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    INFO("seed " << seed);
    const RandomScene scene = random_scene(seed);
    const auto all = features(scene.a, scene.b, scene.threshold);
    const auto one = closest(scene.a, scene.b, scene.threshold);
    const Pair surface = surface_distance(scene.a, scene.b);
    coverage.count(scene, all, one, surface);

    const bool in_contact =
        surface.pierced || surface.distance_squared < Rational(scene.threshold) * scene.threshold;
    CHECK(one.has_value() == in_contact);
    CHECK(all.empty() != in_contact);
    CHECK(surface.pierced == std::ranges::any_of(all, &Named::pierced));
    if (in_contact) {
      CHECK(one->distance_squared == surface.distance_squared);
      CHECK(std::ranges::min(all, {}, &Named::distance).distance == one->distance);
    }
    CHECK(surface.distance_down <= surface.distance_up);
    CHECK(vertex_distance(scene.a, scene.b).distance_squared >= surface.distance_squared);
    for (const Named& contact : all)
      CHECK(std::abs((contact.point_a - contact.point_b).norm() - contact.distance) < 1e-14);
  }
  for (const std::size_t count : coverage.kinds) CHECK(count > 20);
  for (const std::size_t count : coverage.closest_kinds) CHECK(count > 20);
  CHECK(coverage.piercings > 20);
  CHECK(coverage.folds > 20);
  CHECK(coverage.degenerate_faces > 20);
  CHECK(coverage.warped_quads > 20);
  CHECK(coverage.parallel_edges > 20);
  CHECK(coverage.zero_distances > 20);
  CHECK(coverage.at_threshold > 20);
  CHECK(coverage.without_contact > 20);
}
