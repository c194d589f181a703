// Normals of contacts and the sides on which they lie, against the contract's rules worked out by hand, by
// plain formulas on random scenes, and against inside and outside of closed surfaces.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <set>

#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

const Vector3d x = Vector3d::UnitX();
const Vector3d y = Vector3d::UnitY();
const Vector3d z = Vector3d::UnitZ();

Contact closest(const Shape& a, const Shape& b) {
  const PairAnswer answer = detect(surface_of(a), surface_of(b), query_of(ContactDetail::closest, 10));
  REQUIRE(answer.contacts.size() == 1);
  return answer.contacts[0];
}

bool is(const Contact& contact, ContactKind kind, const Vector3d& normal) {
  return contact.kind == kind && (contact.normal - normal).norm() < 1e-14;
}

/// Wound the other way. A quad keeps its first corner, and so its inner diagonal.
Shape reversed(Shape shape) {
  for (auto& face : shape.faces) std::reverse(face.begin() + 1, face.end());
  return shape;
}

/// A closed tetrahedron that points down with vertex 0.
Shape dart(const Vector3d& tip) {
  Shape shape{{tip, tip + Vector3d(1, 0, 3), tip + Vector3d(-1, 1, 3), tip + Vector3d(-1, -1, 3)},
              {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  return reversed(shape);
}

/// A triangle without area from p to q. Its third corner is q again or the middle.
Shape sliver(const Vector3d& p, const Vector3d& q) {
  return triangle(p, q, (p + q) / 2);
}

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> triangles_of(const std::vector<std::uint32_t>& face) {
  std::vector<Triangle> triangles{{face[0], face[1], face[2]}};
  if (face.size() == 4) triangles.push_back({face[0], face[2], face[3]});
  return triangles;
}

/// The unit normal of a triangle, or zero.
Vector3d normal_of(const Shape& shape, const Triangle& t) {
  const Vector3d across = (shape.positions[t[1]] - shape.positions[t[0]])
                              .cross(Vector3d(shape.positions[t[2]] - shape.positions[t[0]]));
  return across.norm() < 1e-12 ? Vector3d::Zero() : Vector3d(across.normalized());
}

/// Whether one of a face's sides joins two vertices. A quad's inner diagonal does not.
bool runs_along(const std::vector<std::uint32_t>& face, std::uint32_t low, std::uint32_t high) {
  for (std::size_t i = 0; i < face.size(); ++i)
    if (std::minmax(face[i], face[(i + 1) % face.size()]) == std::minmax(low, high)) return true;
  return false;
}

/// The angle-weighted normal of a feature by plain formulas over all triangles of the shape. Nothing for a
/// face that is not flat.
std::optional<Vector3d> averaged(const Shape& shape, const Feature& feature) {
  Vector3d sum = Vector3d::Zero();
  if (feature.kind == FeatureKind::face) {
    const auto triangles = triangles_of(shape.faces[feature.index]);
    for (const Triangle& t : triangles)
      if ((normal_of(shape, t) - normal_of(shape, triangles[0])).norm() > 1e-12) return std::nullopt;
    return normal_of(shape, triangles[0]);
  }
  const auto edges = oracle::edges_of(shape);
  for (const auto& face : shape.faces) {
    for (const Triangle& t : triangles_of(face)) {
      const auto at = [&](std::uint32_t vertex) {
        return static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
      };
      if (feature.kind == FeatureKind::vertex && at(feature.index) < 3) {
        const std::size_t i = at(feature.index);
        const Vector3d u = shape.positions[t[(i + 1) % 3]] - shape.positions[t[i]];
        const Vector3d v = shape.positions[t[(i + 2) % 3]] - shape.positions[t[i]];
        if (u.norm() > 0 && v.norm() > 0)
          sum += normal_of(shape, t) * std::acos(std::clamp(u.dot(v) / (u.norm() * v.norm()), -1.0, 1.0));
      }
      if (feature.kind == FeatureKind::edge) {
        const auto [low, high] = edges[feature.index];
        if (runs_along(face, low, high) && at(low) < 3 && at(high) < 3)
          sum += normal_of(shape, t) * std::numbers::pi;
      }
    }
  }
  return sum;
}

/// The contract's normal at distance 0. Nothing where plain formulas cannot be sure.
std::optional<Vector3d> touching_normal(const Shape& a, const Shape& b, const Contact& contact) {
  constexpr double tiny = 1e-6;
  const auto of_a = averaged(a, contact.feature_a);
  const auto of_b = averaged(b, contact.feature_b);
  if (!of_a || !of_b) return std::nullopt;
  for (const Vector3d& n : {*of_a, *of_b})
    if (n.norm() > 0 && n.norm() < tiny) return std::nullopt;
  if (contact.feature_a.kind == FeatureKind::face && !of_a->isZero()) return of_a->normalized();
  if (contact.feature_b.kind == FeatureKind::face && !of_b->isZero()) return -of_b->normalized();
  if (contact.kind == ContactKind::EE) {
    const auto [p, q] = oracle::edges_of(a)[contact.feature_a.index];
    const auto [r, s] = oracle::edges_of(b)[contact.feature_b.index];
    const Vector3d u = a.positions[q] - a.positions[p];
    const Vector3d across = u.cross(Vector3d(b.positions[s] - b.positions[r]));
    if (!across.isZero()) {
      const Vector3d ends = *averaged(a, {FeatureKind::vertex, p}) + *averaged(a, {FeatureKind::vertex, q});
      const double agreement = across.normalized().dot(ends);
      if (std::abs(agreement) < tiny) return std::nullopt;
      return agreement > 0 ? across.normalized() : Vector3d(-across.normalized());
    }
  }
  if (!of_a->isZero()) return of_a->normalized();
  if (!of_b->isZero()) return -of_b->normalized();
  return z;
}

/// How often `surface` winds about `point`: 1 inside a closed surface wound outward, 0 outside.
double winding_number(const Shape& surface, const Vector3d& point) {
  double sum = 0;
  for (const auto& face : surface.faces) {
    for (const Triangle& t : triangles_of(face)) {
      const Vector3d p = surface.positions[t[0]] - point;
      const Vector3d q = surface.positions[t[1]] - point;
      const Vector3d r = surface.positions[t[2]] - point;
      sum += 2 * std::atan2(p.dot(q.cross(r)), p.norm() * q.norm() * r.norm() + p.dot(q) * r.norm() +
                                                   q.dot(r) * p.norm() + r.dot(p) * q.norm());
    }
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace

TEST_CASE("normals: at distance 0 a face of a has its own") {
  const Shape ground = quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  CHECK(is(closest(ground, dart({0.5, 0.25, 0})), ContactKind::VF, z));
  CHECK(is(closest(reversed(ground), dart({0.5, 0.25, 0})), ContactKind::VF, -z));
  CHECK(is(closest(ground, box({-1, -1, 0}, {2, 2, 1})), ContactKind::FF, z));
  CHECK(is(closest(ground, dart({0.5, 0.25, -0.1})), ContactKind::EF, z));  // pierced
  const Shape warped = quad({0, -1, 0}, {1, 0, -1}, {0, 1, 0}, {-1, 0, -1});
  CHECK(is(closest(warped, dart({0, 0.25, 0})), ContactKind::VF, z));  // on the fold: both slopes' average
}

TEST_CASE("normals: at distance 0 else a face of b has minus its own") {
  const Shape ground = quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  CHECK(is(closest(dart({0.5, 0.25, 0}), ground), ContactKind::VF, -z));
  CHECK(is(closest(dart({0.5, 0.25, 0}), reversed(ground)), ContactKind::VF, z));
  CHECK(is(closest(dart({0.5, 0.25, -0.1}), ground), ContactKind::EF, -z));
  CHECK(is(closest(sliver({-1, 0, 0}, {1, 0, 0}), ground), ContactKind::EF, -z));  // lies in it
}

TEST_CASE("normals: of crossing edges their cross product, along a's averaged normal") {
  const Shape roof{{{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1}}, {{0, 1, 2}, {0, 3, 1}}};
  const Shape above{{{0, -1, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}}};
  CHECK(is(closest(roof, above), ContactKind::EE, z));
  CHECK(is(closest(reversed(roof), above), ContactKind::EE, -z));
  CHECK(is(closest(roof, reversed(above)), ContactKind::EE, z));
  const Shape turned_edge{{{0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}}};
  CHECK(is(closest(roof, turned_edge), ContactKind::EE, z));
}

TEST_CASE("normals: of crossing edges, each end of a's edge counts by the angles of its corners") {
  // At the first end a wide corner looks to -x and a little down, at the second a narrow one looks up. The
  // sum of the angle-weighted normals leads down. That of both as unit vectors would lead up.
  const Vector3d in_plane = Vector3d(-0.2, 0, 0.98) * std::cos(1.4);
  const Vector3d aside = y * std::sin(1.4);
  const Shape ends{{{-1, 0, 0},
                    {1, 0, 0},
                    {0, 0, -0.05},
                    -x + in_plane - aside,
                    -x + in_plane + aside,
                    {2, 0, 0},
                    {2, 0.3, 0}},
                   {{0, 1, 2}, {0, 3, 4}, {1, 5, 6}}};
  const Vector3d first = *averaged(ends, {FeatureKind::vertex, 0});
  const Vector3d second = *averaged(ends, {FeatureKind::vertex, 1});
  REQUIRE((first + second).z() < -0.1);
  REQUIRE((first.normalized() + second.normalized()).z() > 0.1);
  const Shape across{{{0, -1, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}}};
  CHECK(is(closest(ends, across), ContactKind::EE, -z));
}

TEST_CASE("normals: a quad that is not flat has those of its triangles, and at its fold their average") {
  const Shape warped = quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 1});
  const Vector3d first = normal_of(warped, {0, 1, 2});
  const Vector3d second = normal_of(warped, {0, 2, 3});
  REQUIRE((first - second).norm() > 0.1);
  const auto normal_at = [&](const Vector3d& tip) {
    const Contact contact = closest(warped, triangle(tip, tip + Vector3d(-1, 0, 4), tip + Vector3d(0, 1, 4)));
    CHECK(contact.kind == ContactKind::VF);
    CHECK(contact.distance == 0);
    return contact.normal;
  };
  CHECK((normal_at({1.5, 0.5, 0}) - first).norm() < 1e-14);
  CHECK((normal_at({0.5, 1.5, 0.5}) - second).norm() < 1e-14);
  CHECK((normal_at({1, 1, 0}) - (first + second).normalized()).norm() < 1e-14);
}

TEST_CASE("normals: where the gap is square to the averaged normal, the push is along the gap") {
  // Two sheets side by side in one plane: nothing says that one lies behind the other.
  const Shape sheet = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const Contact contact = closest(sheet, mapped(sheet, 1, {1.25, 0.5, 0}));
  CHECK(contact.side_a == Side::none);
  CHECK(contact.side_b == Side::none);
  CHECK(contact.separation() == 0.25);
  CHECK(contact.push() == x);
}

TEST_CASE("normals: at distance 0 else a's averaged, else minus b's, else up") {
  const Shape cube = box({-1, -1, -1}, {1, 1, 1});  // corner 7 at the origin
  const Vector3d diagonal = Vector3d(1, 1, 1).normalized();
  CHECK(is(closest(cube, dart({0, 0, 0})), ContactKind::VV, diagonal));
  CHECK(is(closest(cube, dart({-0.5, 0, 0})), ContactKind::VE, (y + z).normalized()));
  const Shape beside = box({-1, 0, 0}, {1, 1, 1});  // an edge in common
  CHECK(is(closest(cube, beside), ContactKind::EE, (y + z).normalized()));
  const Shape point = triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  CHECK(is(closest(point, cube), ContactKind::VV, -diagonal));
  CHECK(is(closest(cube, point), ContactKind::VV, diagonal));
  CHECK(is(closest(point, point), ContactKind::VV, z));
  CHECK(is(closest(sliver({-1, 0, 0}, {1, 0, 0}), point), ContactKind::VV, z));
  CHECK(is(closest(sliver({-1, 0, 0}, {1, 0, 0}), sliver({0.5, 0, 0}, {1.5, 0, 0})), ContactKind::EE, z));
  // Two faces back to back: their average vanishes.
  const Shape leaf{{{0, 0, 0}, {1, 0, -1}, {0, 1, -1}}, {{0, 1, 2}, {0, 2, 1}}};
  const Vector3d of_dart = averaged(dart({0, 0, 0}), {FeatureKind::vertex, 0})->normalized();
  CHECK(of_dart.z() < -0.5);
  CHECK((closest(leaf, dart({0, 0, 0})).normal + of_dart).norm() < 1e-14);
}

TEST_CASE("normals: those of random scenes are the contract's by plain formulas") {
  std::size_t normals = 0;
  std::size_t sides = 0;
  std::set<ContactKind> kinds;
  for (std::uint64_t seed = 1; seed < 2000; seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    for (const ContactDetail detail : {ContactDetail::features, ContactDetail::closest}) {
      const PairAnswer answer =
          detect(surface_of(scene.a), surface_of(scene.b), query_of(detail, scene.threshold));
      for (const Contact& contact : answer.contacts) {
        INFO("seed " << seed << "\n" << text_of(std::vector{contact}));
        CHECK(std::abs(contact.normal.norm() - 1) < 1e-14);
        if (contact.distance > 0) {
          const auto check_side = [&](Side side, const std::optional<Vector3d>& normal, const Vector3d& gap) {
            if (!normal) return;
            const double along = normal->dot(gap);
            if (std::abs(along) > 1e-9) CHECK(side == (along > 0 ? Side::front : Side::back));
            if (along == 0 && normal->isZero()) CHECK(side == Side::none);
            ++sides;
          };
          check_side(contact.side_a, averaged(scene.a, contact.feature_a), contact.normal);
          check_side(contact.side_b, averaged(scene.b, contact.feature_b), -contact.normal);
          continue;
        }
        CHECK(contact.side_a == Side::none);
        CHECK(contact.side_b == Side::none);
        const auto expected = touching_normal(scene.a, scene.b, contact);
        if (!expected) continue;
        CHECK((contact.normal - *expected).norm() < 1e-7);
        kinds.insert(contact.kind);
        ++normals;
      }
    }
  }
  CHECK(normals > 500);
  CHECK(sides > 1000);
  CHECK(kinds.size() == 6);
  std::cout << "compared " << normals << " normals at distance 0 and " << sides << " sides\n";
}

TEST_CASE("normals: a closed surface's closest feature tells inside from outside") {
  std::size_t inside = 0;
  std::size_t outside = 0;
  std::set<std::pair<FeatureKind, Side>> seen;
  const Shape dented = [] {
    Shape shape = box({-1, -1, -1}, {2, 2, 2});
    shape.positions[7] = {-0.1, 0.05, 0.1};  // pushed in: reflex edges and a reflex corner
    return shape;
  }();
  const std::vector<Shape> solids{box({-1, -1, -1}, {2, 2, 2}), dented,
                                  shape_of(models::torus(9, 6, 0.7, 0.3)), shape_of(models::sphere(7, 4))};
  for (std::size_t i = 0; i < solids.size(); ++i) {
    oracle::Random random(i);
    for (int sample = 0; sample < 400; ++sample) {
      const Vector3d p = random.vector(-1.3, 1.3);
      const double winding = winding_number(solids[i], p);
      REQUIRE((std::abs(winding) < 1e-6 || std::abs(winding - 1) < 1e-6));
      const bool is_inside = winding > 0.5;
      (is_inside ? inside : outside) += 1;
      const Contact contact = closest(solids[i], triangle(p, p, p));
      INFO("solid " << i << ", sample " << sample << text_of(std::vector{contact}));
      CHECK(contact.side_a == (is_inside ? Side::back : Side::front));
      const Contact inverted = closest(reversed(solids[i]), triangle(p, p, p));
      CHECK(inverted.side_a == (is_inside ? Side::front : Side::back));
      seen.insert({inverted.feature_a.kind, inverted.side_a});
      seen.insert({contact.feature_a.kind, contact.side_a});
    }
  }
  CHECK(inside > 200);
  CHECK(outside > 200);
  CHECK(seen.size() == 6);  // vertices, edges and faces, from both sides
  std::cout << "compared " << inside << " points inside and " << outside << " outside closed surfaces\n";
}

TEST_CASE("normals: there is no side in the plane of an open surface, nor of nothing") {
  const Shape sheet = quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  const auto side = [](const Shape& a, const Vector3d& p) { return closest(a, triangle(p, p, p)).side_a; };
  CHECK(side(sheet, {1.5, 0, 0}) == Side::none);
  CHECK(side(sheet, {1.5, 1.5, 0}) == Side::none);
  CHECK(side(sheet, {1.5, 0, 0.01}) == Side::front);
  CHECK(side(sheet, {1.5, 1.5, -0.01}) == Side::back);
  CHECK(side(sheet, {0, 0, 0}) == Side::none);
  CHECK(side(sliver({-1, 0, 0}, {1, 0, 0}), {0.25, 0.5, 0.5}) == Side::none);
  CHECK(closest(sheet, triangle(z / 2, z / 2, z / 2)).side_b == Side::none);
  // Wound against each other, the two faces of an edge leave it without a side.
  const Shape against{{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}}};
  CHECK(side(against, {0.25, 0, 0.5}) == Side::none);
  CHECK(side(against, {0.25, 0.25, 0.5}) == Side::front);
  CHECK(side(against, {0.25, -0.25, 0.5}) == Side::back);
}

TEST_CASE("normals: the same input gives the same bits, whatever the detector did before") {
  PairDetector used;
  PairCounters counters;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Surface a = surface_of(scene.a);
    const Surface b = surface_of(scene.b);
    const PairQuery query = query_of(ContactDetail::features, scene.threshold);
    const PairAnswer fresh = detect(a, b, query);
    PairAnswer again;
    used.detect(a, b, query, again, counters);
    REQUIRE(again.contacts.size() == fresh.contacts.size());
    for (std::size_t i = 0; i < fresh.contacts.size(); ++i, ++contacts) {
      CHECK(again.contacts[i].normal == fresh.contacts[i].normal);
      CHECK(again.contacts[i].point_a == fresh.contacts[i].point_a);
      CHECK(again.contacts[i].point_b == fresh.contacts[i].point_b);
      CHECK(again.contacts[i].distance == fresh.contacts[i].distance);
    }
  }
  CHECK(contacts > 500);
}

}  // namespace graze::tests
