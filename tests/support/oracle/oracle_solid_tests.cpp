// The oracle of solids against answers known by hand, and the random scenes with solids.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/exact/exact_winding.hpp"
#include "support/random/random_solids.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Containment;
using oracle::Shape;
using oracle::SolidPair;

constexpr oracle::Solids both_solid{true, true};
constexpr oracle::Solids only_a{true, false};
constexpr oracle::Solids only_b{false, true};

Shape cube(const Vector3d& low, double size) {
  Shape shape;
  for (unsigned i = 0; i < 8; ++i)
    shape.positions.emplace_back(low + size * Vector3d(i & 1U, (i >> 1U) & 1U, i >> 2U));
  shape.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return shape;
}

Shape inside_out(Shape shape) {
  for (auto& face : shape.faces) std::reverse(face.begin(), face.end());
  return shape;
}

Shape together(Shape shape, const Shape& part) {
  const auto first = static_cast<std::uint32_t>(shape.positions.size());
  shape.positions.insert(shape.positions.end(), part.positions.begin(), part.positions.end());
  for (auto face : part.faces) {
    for (std::uint32_t& corner : face) corner += first;
    shape.faces.push_back(face);
  }
  return shape;
}

int number_at(const Shape& shape, const Vector3d& point) {
  return oracle::winding(shape, point).number;
}

bool is_on(const Shape& shape, const Vector3d& point) {
  return oracle::winding(shape, point).on_surface;
}

/// The solid angle of a triangle seen from the origin, by its winding: van Oosterom and Strackee's formula.
double solid_angle(const Vector3d& p, const Vector3d& q, const Vector3d& r) {
  const double lengths = p.norm() * q.norm() * r.norm();
  const double rest = p.dot(q) * r.norm() + q.dot(r) * p.norm() + r.dot(p) * q.norm();
  return 2 * std::atan2(p.dot(q.cross(r)), lengths + rest);
}

/// The winding number in plain double, for points that are not close to the surface.
double rough_winding(const Shape& shape, const Vector3d& point) {
  double sum = 0;
  for (const auto& face : shape.faces) {
    const Vector3d first = shape.positions[face[0]] - point;
    for (std::size_t i = 2; i < face.size(); ++i)
      sum += solid_angle(first, shape.positions[face[i - 1]] - point, shape.positions[face[i]] - point);
  }
  return sum / (4 * std::numbers::pi);
}

Containment inside_of(const Shape& a, const Shape& b, oracle::Solids solids) {
  return oracle::solid_pair(a, b, solids, 0).inside;
}

}  // namespace

TEST_CASE("winding oracle: a cube, and a cube inside out") {
  const Shape shape = cube({0, 0, 0}, 2);
  CHECK(number_at(shape, {1, 1, 1}) == 1);
  CHECK(number_at(shape, {0.5, 0.5, 1.5}) == 1);
  CHECK(number_at(shape, {3, 1, 1}) == 0);
  CHECK(number_at(inside_out(shape), {1, 1, 1}) == -1);
  CHECK(oracle::winding(inside_out(shape), {1, 1, 1}).is_inside());
}

TEST_CASE("winding oracle: on faces, quads' diagonals, edges and corners") {
  const Shape shape = cube({0, 0, 0}, 2);
  for (const Vector3d& point : {Vector3d(1, 0.5, 0), Vector3d(1, 1, 2), Vector3d(0, 1, 0),
                                Vector3d(2, 2, 0.25), Vector3d(0, 0, 0), Vector3d(2, 2, 2)}) {
    CHECK(is_on(shape, point));
    CHECK(number_at(shape, point) == 0);
  }
  // In the plane of a face, on the line of an edge, and a hair beside a face.
  CHECK_FALSE(is_on(shape, {3, 1, 0}));
  CHECK_FALSE(is_on(shape, {3, 0, 0}));
  CHECK_FALSE(is_on(shape, {1, 1, 0x1p-50}));
  CHECK(number_at(shape, {1, 1, 0x1p-50}) == 1);
  CHECK(number_at(shape, {1, 1, -0x1p-50}) == 0);
}

TEST_CASE("winding oracle: parts that overlap, a cavity, a core") {
  const Shape two = together(cube({0, 0, 0}, 2), cube({1, 1, 1}, 2));
  CHECK(number_at(two, {1.5, 1.5, 1.5}) == 2);
  CHECK(number_at(two, {0.5, 0.5, 0.5}) == 1);
  CHECK(number_at(two, {2.5, 2.5, 2.5}) == 1);
  CHECK(number_at(two, {2.5, 0.5, 0.5}) == 0);
  CHECK(is_on(two, {1, 1.5, 1.5}));
  const Shape hollow = together(cube({0, 0, 0}, 4), inside_out(cube({1, 1, 1}, 2)));
  CHECK(number_at(hollow, {2, 2, 2}) == 0);
  CHECK(number_at(hollow, {0.5, 2, 2}) == 1);
  const Shape against = together(cube({0, 0, 0}, 2), inside_out(cube({1, 1, 1}, 2)));
  CHECK(number_at(against, {1.5, 1.5, 1.5}) == 0);
  CHECK(number_at(against, {2.5, 2.5, 2.5}) == -1);
  const Shape cored = together(cube({0, 0, 0}, 4), cube({1, 1, 1}, 2));
  CHECK(number_at(cored, {2, 2, 2}) == 2);
}

TEST_CASE("winding oracle: a warped quad is its two triangles") {
  Shape shape = cube({0, 0, 0}, 2);
  shape.faces[1] = {4, 5, 7, 6};
  shape.positions[5] = {2, 0, 3};
  // The top is (4, 5, 7) and (4, 7, 6). Only the first rises, to 3 at vertex 5.
  CHECK(number_at(shape, {1.5, 0.5, 2.25}) == 1);
  CHECK(number_at(shape, {0.5, 1.5, 2.25}) == 0);
  CHECK(is_on(shape, {1.5, 0.5, 2.5}));
  CHECK(is_on(shape, {0.5, 1.5, 2}));
  shape.faces[1] = {5, 7, 6, 4};
  // The other diagonal joins vertices 5 and 6, from (2, 0, 3) to (0, 2, 2): both triangles rise.
  CHECK(number_at(shape, {0.5, 1.25, 2.0625}) == 1);
}

TEST_CASE("winding oracle: a flat surface has no inside") {
  const Shape flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  CHECK(is_on(flat, {1, 1, 0}));
  CHECK_FALSE(is_on(flat, {3, 3, 0}));
  CHECK(number_at(flat, {3, 3, 0}) == 0);
  CHECK(number_at(flat, {1, 1, 0.5}) == 0);
  const Shape line{{{0, 0, 0}, {1, 1, 1}, {4, 4, 4}}, {{0, 1, 2}, {0, 2, 1}}};
  CHECK(is_on(line, {3, 3, 3}));
  CHECK_FALSE(is_on(line, {3, 3, 2}));
}

TEST_CASE("winding oracle: 64 bits give the same answers as integers of any length") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed < 200; seed += 2) {
    const oracle::RandomSolids scene = oracle::random_solids(seed);
    if (!oracle::is_closed(scene.b)) continue;
    const oracle::WindingOracle winding(scene.b);
    for (const Vector3d& point : scene.a.positions) {
      if (!point.allFinite()) continue;
      const oracle::Winding few = winding.about(point);
      const oracle::Winding any = winding.about_in_any_length(point);
      CHECK(few.number == any.number);
      CHECK(few.on_surface == any.on_surface);
      ++compared;
    }
  }
  CHECK(compared > 500);
}

TEST_CASE("winding oracle: the sum of solid angles gives the same numbers") {
  oracle::Random random(3);
  std::map<int, std::size_t> counts;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Shape shape = oracle::random_solids(seed).a;
    if (!oracle::is_closed(shape)) continue;
    INFO("seed " << seed);
    const auto corner = [&] {
      return shape.positions[shape.faces[random.below(static_cast<std::uint32_t>(shape.faces.size()))][0]];
    };
    for (int i = 0; i < 20; ++i) {
      const Vector3d first = corner();
      const Vector3d point = (first + corner()) / 2 + random.vector(-2, 2);
      const oracle::Winding about = oracle::winding(shape, point);
      CHECK_FALSE(about.on_surface);
      CHECK(std::abs(rough_winding(shape, point) - about.number) < 1e-6);
      ++counts[about.number];
    }
  }
  for (const int number : {-2, -1, 0, 1, 2}) CHECK(counts[number] > 10);
  CHECK(counts[1] > 1000);
}

TEST_CASE("oracle of solids: a cube in a cube") {
  const Shape large = cube({-4, -4, -4}, 8);
  const Shape small = cube({-1, -1, 0}, 2);
  CHECK(inside_of(large, small, both_solid) == Containment::b_in_a);
  CHECK(inside_of(small, large, both_solid) == Containment::a_in_b);
  CHECK(inside_of(large, small, only_a) == Containment::b_in_a);
  CHECK(inside_of(large, small, only_b) == Containment::none);
  CHECK(inside_of(large, small, {}) == Containment::none);
  CHECK(inside_of(inside_out(large), small, both_solid) == Containment::b_in_a);

  const SolidPair pair = oracle::solid_pair(large, small, both_solid, 0.5);
  CHECK(pair.has_vertex_inside);
  REQUIRE(pair.contacts.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(pair.contacts[i].kind == ContactKind::VF);
    // The upper ones are 2 below the top. The lower ones are 3 from two sides, of which face 2 is the lower.
    CHECK(pair.contacts[i].distance == (pair.contacts[i].b.index >= 4 ? 2 : 3));
    CHECK(pair.sides[i].a == Side::back);
    CHECK_FALSE(pair.sides[i].b.has_value());
  }
}

TEST_CASE("oracle of solids: sides of vertices near a solid") {
  const Shape large = cube({-4, -4, -4}, 8);
  const SolidPair above = oracle::solid_pair(large, cube({-1, -1, 4.25}, 2), both_solid, 0.5);
  REQUIRE(above.contacts.size() == 4);
  for (const oracle::SolidSides& sides : above.sides) CHECK(sides.a == Side::front);
  CHECK_FALSE(above.has_vertex_inside);
  CHECK(above.inside == Containment::none);
  const SolidPair on_top = oracle::solid_pair(large, cube({-1, -1, 4}, 2), both_solid, 0.5);
  REQUIRE(on_top.contacts.size() == 4);
  for (const oracle::SolidSides& sides : on_top.sides) CHECK(sides.a == Side::none);
  CHECK(on_top.inside == Containment::none);
  // Corner at corner: one VV, with the sides of both solids.
  const SolidPair corners = oracle::solid_pair(large, cube({4, 4, 4.25}, 2), both_solid, 0.375);
  REQUIRE(corners.contacts.size() == 1);
  CHECK(corners.contacts[0].kind == ContactKind::VV);
  CHECK(corners.sides[0].a == Side::front);
  CHECK(corners.sides[0].b == Side::front);
}

TEST_CASE("oracle of solids: crossing with and without piercing") {
  const Shape large = cube({-4, -4, -4}, 8);
  CHECK(inside_of(large, cube({3, 3, 3}, 2), both_solid) == Containment::crossing);
  CHECK(inside_of(large, cube({3, 3, 3}, 2), only_b) == Containment::crossing);
  CHECK(inside_of(large, cube({3, 3, 3}, 2), {}) == Containment::none);
  // A bar through the cube has no vertex inside.
  const Shape bar{{{0, 0, -8}, {0, 0.5, 8}, {0.25, 0, 8}}, {{0, 1, 2}}};
  const SolidPair through = oracle::solid_pair(large, bar, only_a, 0);
  CHECK(through.inside == Containment::crossing);
  CHECK_FALSE(through.has_vertex_inside);
  // Inside with its tip on the top: the tip is not inside, and nothing pierces.
  const Shape tip{{{0, 0, 4}, {1, 0, 2}, {0, 1, 2}}, {{0, 1, 2}}};
  const SolidPair touching = oracle::solid_pair(large, tip, only_a, 0);
  CHECK(touching.inside == Containment::crossing);
  CHECK(touching.contacts.size() == 2);
}

TEST_CASE("oracle of solids: in a cavity, in a part of two") {
  const Shape hollow = together(cube({0, 0, 0}, 8), inside_out(cube({2, 2, 2}, 4)));
  CHECK(inside_of(hollow, cube({3, 3, 3}, 1), both_solid) == Containment::none);
  CHECK(inside_of(hollow, cube({0.5, 0.5, 0.5}, 1), both_solid) == Containment::b_in_a);
  // All vertices of b are in the wall, and the cavity in b: b lies in a by the rule, though not as a volume.
  CHECK(inside_of(hollow, cube({1, 1, 1}, 6), both_solid) == Containment::b_in_a);
  const Shape apart = together(cube({0, 0, 0}, 4), cube({9, 0, 0}, 4));
  CHECK(inside_of(apart, together(cube({1, 1, 1}, 1), cube({10, 1, 1}, 1)), both_solid) ==
        Containment::b_in_a);
  CHECK(inside_of(apart, together(cube({1, 1, 1}, 1), cube({6, 1, 1}, 1)), both_solid) ==
        Containment::crossing);
}

TEST_CASE("random solids: a closed surface passes each edge once in both directions") {
  CHECK(oracle::is_closed(cube({0, 0, 0}, 1)));
  Shape open = cube({0, 0, 0}, 1);
  open.faces.pop_back();
  CHECK_FALSE(oracle::is_closed(open));
  Shape turned = cube({0, 0, 0}, 1);
  std::reverse(turned.faces[3].begin(), turned.faces[3].end());
  CHECK_FALSE(oracle::is_closed(turned));
  Shape doubled = cube({0, 0, 0}, 1);
  for (int i = 0; i < 6; ++i) doubled.faces.push_back(doubled.faces[static_cast<std::size_t>(i)]);
  CHECK_FALSE(oracle::is_closed(doubled));
}

TEST_CASE("random solids are as they say, and reach every case") {
  oracle::SolidCoverage coverage;
  std::size_t open = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const oracle::RandomSolids scene = oracle::random_solids(seed);
    INFO("seed " << seed);
    CHECK((!scene.solids.a || oracle::is_closed(scene.a)));
    CHECK((!scene.solids.b || oracle::is_closed(scene.b)));
    open += oracle::is_closed(scene.a) && oracle::is_closed(scene.b) ? 0U : 1U;
    coverage.count(scene);
  }
  for (const std::size_t reached : coverage.containments) CHECK(reached > 10);
  CHECK(open > 50);
  CHECK(coverage.inside_by_winding_two > 20);
  CHECK(coverage.inside_by_negative > 100);
  CHECK(coverage.on_surface > 100);
  CHECK(coverage.deep_contacts > 100);
  CHECK(coverage.both_sides > 50);
  CHECK(coverage.without_piercing > 5);
}

}  // namespace graze::tests
