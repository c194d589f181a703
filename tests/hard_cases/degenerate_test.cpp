// Faces without area, repeated and duplicate ones, needles, and edges that vanish while the scene runs.

#include <iostream>

#include "hard_cases/scene_comparison.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

std::uint32_t last(const Shape& shape) {
  return static_cast<std::uint32_t>(shape.positions.size()) - 1;
}

std::vector<std::uint32_t>& any_face(Shape& shape, Random& random) {
  return shape.faces[random.below(static_cast<std::uint32_t>(shape.faces.size()))];
}

/// Puts one corner of a face on another, on the line through two others, or past their end.
void flatten_face(Shape& shape, Random& random) {
  const auto& face = any_face(shape, random);
  const Vector3d& first = shape.positions[face[0]];
  const Vector3d& second = shape.positions[face[1]];
  const std::array fractions{0.0, 0.5, 1.0, 1.5, -0.25};
  shape.positions[face[2]] = first + (second - first) * fractions[random.below(5)];
}

void repeat_corner(Shape& shape, Random& random) {
  auto& face = any_face(shape, random);
  const auto size = static_cast<std::uint32_t>(face.size());
  face[random.below(size)] = face[random.below(size)];
}

void duplicate_face(Shape& shape, Random& random) {
  auto face = any_face(shape, random);
  if (random.chance(0.5)) std::swap(face[1], face[2]);
  shape.faces.push_back(face);
}

/// Another vertex at the same place, which takes over one corner.
void duplicate_vertex(Shape& shape, Random& random) {
  auto& face = any_face(shape, random);
  auto& corner = face[random.below(static_cast<std::uint32_t>(face.size()))];
  shape.positions.emplace_back(shape.positions[corner]);
  corner = last(shape);
}

void add_unused_vertex(Shape& shape, Random& random) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  shape.positions.emplace_back(random.between(0, 1), nothing, 0x1p1000);
}

Shape degenerate(Shape shape, Random& random) {
  const std::array spoil{flatten_face, repeat_corner, duplicate_face, duplicate_vertex, add_unused_vertex};
  for (std::uint32_t i = 0; i < 3; ++i) spoil[random.below(5)](shape, random);
  return shape;
}

/// Whether every name in `features` of kinds with faces is of a face with area.
bool names_areas_only(const std::vector<oracle::Named>& contacts, const Shape& a, const Shape& b) {
  const auto has_area = [](const Shape& shape, const Feature& feature) {
    if (feature.kind != FeatureKind::face) return true;
    const auto& face = shape.faces[feature.index];
    const auto area = [&](std::size_t second, std::size_t third) {
      const Vector3d& origin = shape.positions[face[0]];
      return (shape.positions[face[second]] - origin).cross(shape.positions[face[third]] - origin).norm();
    };
    return area(1, 2) > 0 || (face.size() == 4 && area(2, 3) > 0);
  };
  for (const oracle::Named& contact : contacts)
    if (!has_area(a, contact.a) || !has_area(b, contact.b)) return false;
  return true;
}

}  // namespace

TEST_CASE("zero-area and collinear faces, repeated and duplicate ones, duplicate and unused vertices") {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed + 9000);
    oracle::RandomScene given = oracle::random_scene(seed);
    const Shape a = degenerate(given.a, random);
    const Shape b = degenerate(given.b, random);
    INFO("seed " << seed << "\na: " << text_of(a) << "b: " << text_of(b));
    tally.compare({a, b}, given.threshold);
    if (given.on_grid) CHECK(names_areas_only(oracle::features(a, b, given.threshold), a, b));
  }
  CHECK(tally.contacts > 2000);
  tally.print("degenerate faces");
}

TEST_CASE("zero-area faces: edges and faces that collapse at run time and come back") {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Random random(seed + 9500);
    const oracle::RandomScene given = oracle::random_scene(seed);
    Body a = given.a;
    Body b = given.b;
    for (Body* body : {&a, &b})
      for (int i = 0; i < 2; ++i) flatten_face(body->now, random);
    INFO("seed " << seed);
    tally.compare({a, b}, given.threshold);

    // A scene that has seen them whole says of them collapsed, and whole again, what it should.
    BodyScene scene({a, b}, settings_of(given.threshold, infinity));
    const Tolerance whole(a.rest, b.rest);
    const auto expected = oracle::features(a.rest, b.rest, given.threshold);
    for (int round = 0; round < 2; ++round) {
      CHECK(difference_of(scene.step({a.rest, b.rest})->contacts(), expected, whole) == "");
      CHECK(difference_of(scene.step({a, b})->contacts(), oracle::features(a.now, b.now, given.threshold),
                          Tolerance(a.now, b.now)) == "");
    }
  }
  CHECK(tally.contacts > 1000);
  tally.print("faces collapsed at run time");
}

TEST_CASE("needles of aspect 10^9") {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const auto needle = [&](std::uint64_t turn) {
      const double at = random.between(0, 1);
      return turned(triangle({0, 0, 0}, {1, 0, 0}, {at, random.chance(0.5) ? 1e-9 : -1e-9, 0}), turn);
    };
    const Shape a = needle(seed);
    const double height = random.chance(0.3) ? 1e-9 : random.between(0, 0.2);
    const std::uint64_t turn = random.chance(0.3) ? seed : seed + 1000;  // often parallel
    const Shape b = mapped(needle(turn), 1, {height, random.between(-0.2, 0.2), random.between(-1e-9, 1e-9)});
    INFO("seed " << seed);
    tally.compare({a, b}, random.chance(0.5) ? 0.3 : 2e-9);
  }
  CHECK(tally.contacts > 500);
  tally.print("needles");
}

TEST_CASE("1,000 vertices in one point; one face; no face; a face larger than the scene") {
  Shape heap{std::vector<Vector3d>(1000, Vector3d(0.25, 0.5, 0.125)), {}};
  for (std::uint32_t i = 0; i + 3 <= 1000; i += 3) heap.faces.push_back({i, i + 1, i + 2});
  Shape spread = heap;
  for (std::uint32_t i = 0; i < 1000; i += 100) spread.positions[i] += Vector3d(1, i / 500.0, 0.5);
  const Shape cube = box({0.5, 0, 0}, {1, 1, 1});
  const Shape one_face = triangle({0, 0, 1.25}, {1, 0, 1.25}, {0, 1, 1.125});
  const Shape large = quad({-1e6, -1e6, -0.125}, {1e6, -1e6, -0.125}, {1e6, 1e6, -0.25}, {-1e6, 1e6, -0.125});
  Tally tally;
  tally.compare({heap, cube}, 0.375);
  tally.compare({heap, one_face}, 1.25);
  tally.compare({Body(heap, spread), cube}, 0.25);   // spread at run time
  tally.compare({Body(spread, heap), cube}, 0.375);  // heaped at run time
  const Shape small_heap{std::vector<Vector3d>(40, Vector3d(0, 0, 0.0625)), {{0, 9, 7, 5}, {39, 21, 3}}};
  tally.compare({heap, mapped(small_heap, 1, heap.positions[0])}, 0.0625);
  tally.compare({small_heap, mapped(small_heap, 1, {0.03125, 0, 0})}, 0.05);
  tally.compare({one_face, one_face}, 0.25);
  tally.compare({one_face, cube, large, mapped(cube, 0.5, {3, 4, 0})}, 0.5);
  CHECK(tally.contacts > 1000);
  tally.print("heaps, single faces and a large one");

  const std::vector<std::array<std::uint32_t, 3>> none;
  CHECK_THROWS_AS(Mesh::from_triangles(heap.positions, none), Error);
}

}  // namespace graze::tests
