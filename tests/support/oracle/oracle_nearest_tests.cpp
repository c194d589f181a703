// The oracle of detail `nearest` against answers known by hand.

#include <algorithm>

#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/oracle/oracle_nearest.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Named;
using oracle::Shape;

std::string nearest_text(const Shape& a, const Shape& b, double threshold) {
  return text_of(oracle::nearest(a, b, threshold));
}

Shape triangle_of(const Vector3d& p, const Vector3d& q, const Vector3d& r) {
  return {{p, q, r}, {{0, 1, 2}}};
}

/// A needle with its tip at vertex 0 and a far end.
Shape needle_at(const Vector3d& tip, const Vector3d& away) {
  const Vector3d side = away.unitOrthogonal() * 0.01;
  return triangle_of(tip, tip + 10 * away + side, tip + 10 * away - side);
}

/// A bar: a thin triangle. Its edge 0 runs from p to q, and its third corner lies far away.
Shape bar_along(const Vector3d& p, const Vector3d& q, const Vector3d& away) {
  return triangle_of(p, q, (p + q) / 2 + away);
}

/// Two triangles over a square of side 4 about the origin. Edge 2 is their diagonal, along x = y. Its ends
/// are raised by `ridge`.
Shape folded_square(double ridge) {
  return {{{-2, -2, ridge}, {2, -2, 0}, {2, 2, ridge}, {-2, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// The square as one quad. Its diagonal is no edge.
Shape folded_quad(double ridge) {
  Shape shape = folded_square(ridge);
  shape.faces = {{0, 1, 2, 3}};
  return shape;
}

Shape cube_of_triangles(const Vector3d& low, double size) {
  Shape shape;
  for (unsigned i = 0; i < 8; ++i)
    shape.positions.emplace_back(low + size * Vector3d(i & 1U, (i >> 1U) & 1U, i >> 2U));
  shape.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

}  // namespace

TEST_CASE("oracle of nearest: a cube over a plate has one contact for each vertex below") {
  const Shape cube = cube_of_triangles({0.25, 0, 0.25}, 0.125);
  // Vertex 0 is at (0.25, 0), vertex 2 at (0.25, 0.125): all are below the diagonal, inside of face 0.
  CHECK(nearest_text(folded_square(0), cube, 0.3) ==
        "  VF f0 v0 at 0.25\n  VF f0 v1 at 0.25\n  VF f0 v2 at 0.25\n  VF f0 v3 at 0.25\n");
}

TEST_CASE("oracle of nearest: a vertex over the edge of two faces is one VE") {
  CHECK(nearest_text(folded_square(0), needle_at({1, 1, 0.5}, {0, 0, 1}), 1) == "  VE e2 v0 at 0.5\n");
  CHECK(nearest_text(folded_quad(0), needle_at({1, 1, 0.5}, {0, 0, 1}), 1) == "  VF f0 v0 at 0.5\n");
}

TEST_CASE("oracle of nearest: a vertex has only its closest point") {
  // Near a corner of 90 degrees, 0.25 from the floor and 0.5 from the wall.
  const Shape corner{{{-2, 0, 0}, {2, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {{0, 1, 2}, {1, 0, 3}}};
  const Shape tip = needle_at({0, 0.5, 0.25}, Vector3d(0, 1, 1).normalized());
  CHECK(oracle::features(corner, tip, 0.6).size() > 1);
  CHECK(nearest_text(corner, tip, 0.6) == "  VF f0 v0 at 0.25\n");
}

TEST_CASE("oracle of nearest: equally close points go to the lowest feature") {
  // As far from the floor as from the wall: face 0 is the floor.
  const Shape corner{{{-2, 0, 0}, {2, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {{0, 1, 2}, {1, 0, 3}}};
  const Shape tip = needle_at({0, 0.5, 0.5}, Vector3d(0, 1, 1).normalized());
  CHECK(nearest_text(corner, tip, 0.6) == "  VF f0 v0 at 0.5\n");
  const Shape other{corner.positions, {{1, 0, 3}, {0, 1, 2}}};
  CHECK(nearest_text(other, tip, 0.6) == "  VF f0 v0 at 0.5\n");
  // A vertex midway between a corner and a face: the corner has the lower kind.
  const Shape between{{{0, 0, 1}, {1, 0, 9}, {-1, 0, 9}, {-9, -9, -1}, {9, -9, -1}, {0, 9, -1}},
                      {{3, 4, 5}, {0, 1, 2}}};
  const Shape middle = needle_at({0, 0, 0}, {0, 1, 0});
  CHECK(nearest_text(between, middle, 1.1).starts_with("  VV v0 v0 at 1\n"));
}

TEST_CASE("oracle of nearest: a vertex at the threshold is no contact") {
  const Shape tip = needle_at({0.5, 0, 0.5}, {0, 0, 1});
  CHECK(nearest_text(folded_square(0), tip, 0.5).empty());
  CHECK(nearest_text(folded_square(0), tip, 0.5 + 0x1p-40) == "  VF f0 v0 at 0.5\n");
}

TEST_CASE("oracle of nearest: ridges are listed, valleys and edges in flat surfaces are not") {
  // A bar 0.5 above the middle, across the diagonal.
  const Shape bar = bar_along({-1, 1, 0.5}, {1, -1, 0.5}, {0, 0, 20});
  const std::string ends = "  VF f0 v1 at 0.5\n  VF f1 v0 at 0.5\n";
  CHECK(oracle::features(folded_square(0), bar, 1).size() == 3);
  // In a flat surface no face leads nearer, but the edge bounds nothing.
  CHECK(nearest_text(folded_square(0), bar, 1) == ends);
  const std::string on_ridge = nearest_text(folded_square(0.25), bar, 1);
  CHECK(on_ridge.find("EE e2 e0 at 0.25") != std::string::npos);
  // In a valley both faces lead up to the bar. Where it is a crease and shallow, it bounds a patch.
  const Shape low_bar = bar_along({-1, 1, 0.125}, {1, -1, 0.125}, {0, 0, 20});
  const auto near_valley = oracle::features(folded_square(-0.75), low_bar, 1);
  CHECK(std::any_of(near_valley.begin(), near_valley.end(),
                    [](const Named& named) { return named.kind == ContactKind::EE; }));
  CHECK(nearest_text(folded_square(-0.75), low_bar, 1).find("EE") == std::string::npos);
  CHECK(nearest_text(folded_square(-0.25), bar, 1).find("EE e2 e0 at 0.75") != std::string::npos);
  CHECK(nearest_text(folded_square(-0.0625), bar, 1).find("EE") == std::string::npos);
}

TEST_CASE("oracle of nearest: the fold of a quad is no edge, and a contact only where it is alone") {
  const Shape bar = bar_along({-1, 1, 0.5}, {1, -1, 0.5}, {0, 0, 20});
  const auto listed = oracle::features(folded_quad(0.25), bar, 0.3);
  REQUIRE(listed.size() == 1);
  CHECK(listed[0].kind == ContactKind::EF);
  CHECK(nearest_text(folded_quad(0.25), bar, 0.3) == "  EF f0 e0 at 0.25\n");
  CHECK(nearest_text(folded_quad(0.25), bar, 0.25).empty());
  const std::string with_vertices = nearest_text(folded_quad(0.25), bar, 1);
  CHECK(with_vertices.find("VF") != std::string::npos);
  CHECK(with_vertices.find("EF") == std::string::npos);
}

TEST_CASE("oracle of nearest: both edges have to be locally closest") {
  // The bar's own face hangs down from it, on the far side of the ridge's edge or on the near one.
  const Shape ridge = folded_square(0.25);
  const Vector3d p(-1, 1, 0.5), q(1, -1, 0.5);
  CHECK(nearest_text(ridge, bar_along(p, q, {3, 3, 0.5}), 0.3) == "  EE e2 e0 at 0.25\n");
  const Shape hanging = bar_along(p, q, {3, 3, -1.5});
  const auto listed = oracle::features(ridge, hanging, 0.3);
  CHECK(std::any_of(listed.begin(), listed.end(), [](const Named& n) { return n.kind == ContactKind::EE; }));
  CHECK(nearest_text(ridge, hanging, 0.3).find("EE") == std::string::npos);
}

TEST_CASE("oracle of nearest: edges that cross are listed, parallel ones are not") {
  const Shape up = bar_along({-1, 0, 0}, {1, 0, 0}, {0, 0, 3});
  const Shape down = bar_along({0, -1, 0}, {0, 1, 0}, {0, 0, -3});
  CHECK(nearest_text(up, down, 0.1) == "  EE e0 e0 at 0\n");
  CHECK(nearest_text(up, down, 0).empty());
  const Shape beside = bar_along({-2, 0, -0.25}, {2, 0, -0.25}, {0, 0, -3});
  CHECK(nearest_text(up, beside, 0.3) == "  VE v0 e0 at 0.25\n  VE v1 e0 at 0.25\n");
}

TEST_CASE("oracle of nearest: an edge that pierces a face is listed at every threshold") {
  const Shape bar = bar_along({0.5, 0.25, -1}, {0.5, 0.25, 1}, {20, 0, 0});
  const auto listed = oracle::nearest(folded_square(0), bar, 0);
  REQUIRE(!listed.empty());
  for (const Named& contact : listed) {
    CHECK(contact.kind == ContactKind::EF);
    CHECK(contact.pierced);
    CHECK(contact.distance == 0);
  }
}

TEST_CASE("oracle of nearest: ridges of two cubes, square to each other") {
  // The upper edge of one along x, at y = z = 0. The lower edge of the other along y, at x = 0, z = 0.25.
  Shape lower = cube_of_triangles({0, 0, 0}, 1);
  for (Vector3d& p : lower.positions) p = Vector3d(2 * p.x() - 1, p.y() - p.z(), p.y() + p.z() - 2);
  Shape upper = cube_of_triangles({0, 0, 0}, 1);
  for (Vector3d& p : upper.positions) p = Vector3d(p.x() - p.z(), 2 * p.y() - 1, p.x() + p.z() + 0.25);
  const auto listed = oracle::nearest(lower, upper, 0.375);
  REQUIRE(listed.size() == 1);
  CHECK(listed[0].kind == ContactKind::EE);
  CHECK(listed[0].distance == 0.25);
  CHECK(listed[0].point_a == Vector3d(0, 0, 0));
  CHECK(listed[0].point_b == Vector3d(0, 0, 0.25));
}

TEST_CASE("oracle of nearest: the closest point of a surface is that of the nearest face") {
  std::size_t ties = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const oracle::ExactShape a(scene.a);
    const oracle::ExactShape b(scene.b);
    for (const std::uint32_t vertex : a.used) {
      const auto foot =
          oracle::foot_on_surface(a.points[vertex], a.point_extents[vertex], b, oracle::Limit::none());
      REQUIRE(foot.has_value());
      std::size_t as_near = 0;
      for (std::uint32_t face = 0; face < b.faces.size(); ++face) {
        const oracle::Foot of_face = oracle::foot_on_face(a.points[vertex], b, face);
        CHECK(foot->distance_squared <= of_face.distance_squared);
        if (foot->distance_squared != of_face.distance_squared) continue;
        CHECK(foot->feature <= of_face.feature);
        as_near += foot->feature == of_face.feature ? 1U : 0U;
        ties += foot->feature == of_face.feature ? 0U : 1U;
      }
      CHECK(as_near > 0);
    }
  }
  CHECK(ties > 10);
}

TEST_CASE("oracle of nearest: it lists a part of `features`, and each vertex once") {
  std::size_t listed = 0;
  std::size_t left_out = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    INFO("seed " << seed);
    const auto all = oracle::features(scene.a, scene.b, scene.threshold);
    const auto nearest = oracle::nearest(scene.a, scene.b, scene.threshold);
    std::vector<std::string> names;
    for (const Named& contact : all) names.push_back(text_of(std::vector{contact}));
    for (const Named& contact : nearest) {
      const std::string text = text_of(std::vector{contact});
      CHECK(std::find(names.begin(), names.end(), text) != names.end());
    }
    listed += nearest.size();
    left_out += all.size() - nearest.size();
  }
  CHECK(listed > 300);
  CHECK(left_out > 300);
}

}  // namespace graze::tests
