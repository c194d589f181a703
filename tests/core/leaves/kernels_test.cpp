// The kernels where they are hardest, beside changes of kind. Everything is compared with the oracle.

#include <cmath>
#include <iostream>

#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

/// Two shapes half a unit apart whose one closest contact is of a known kind, and the directions along which
/// a small move of b brings another kind.
struct Case {
  std::string name;
  ContactKind closest;
  Shape a, b;
  std::vector<Vector3d> changes;
};

/// A thin triangle that stands on its vertex 0.
Shape stake(const Vector3d& tip) {
  return triangle(tip, tip + Vector3d(0.25, 0, 4), tip + Vector3d(0, 0.25, 4));
}

/// A triangle that stands on its edge 0, from p to q.
Shape blade(const Vector3d& p, const Vector3d& q) {
  return triangle(p, q, (p + q) / 2 + Vector3d(0, 0, 8));
}

/// A quad whose inner diagonal is a ridge along y at height 0.
Shape roof() {
  return quad({0, -1, 0}, {1, 0, -1}, {0, 1, 0}, {-1, 0, -1});
}

std::vector<Case> cases() {
  const Shape ground = quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  const Shape below = triangle({-2, 0, 0}, {2, 0, 0}, {0, 0, -8});
  const Shape valley = quad({-1, 0, 0.5}, {0, -1, 1.5}, {1, 0, 0.5}, {0, 1, 1.5});
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  using enum ContactKind;
  return {
      {"VV, corner over corner", VV, ground, stake({2, 2, 0.5}), {x, y}},
      {"VV, beside a corner", VV, ground, stake({2.5, 2, 0}), {x, y, z}},
      {"VE, over the middle of a border", VE, ground, stake({2, 0.5, 0.5}), {x, y}},
      {"VE, over the end of a border", VV, below, stake({2, 0, 0.5}), {x, y}},
      {"VF, over the inside", VF, ground, stake({0.5, 0.25, 0.5}), {x, y}},
      {"VF, over a flat quad's diagonal", VF, ground, stake({0.5, 0.5, 0.5}), {x, y}},
      {"VF, over a fold", VF, roof(), stake({0, 0.25, 0.5}), {x, y}},
      {"EE, crossing", EE, below, blade({0.25, -2, 0.5}, {0.25, 2, 0.5}), {x, y}},
      {"EE, crossing at an end", VE, below, blade({2, -2, 0.5}, {2, 2, 0.5}), {x}},
      {"EE, parallel", EE, below, blade({-1, 0, 0.5}, {3, 0, 0.5}), {x, y}},
      {"EE, parallel, meeting in one point", VV, below, blade({2, 0, 0.5}, {4, 0, 0.5}), {x, y}},
      {"EF, parallel over the inside", EF, ground, blade({-1, 0.25, 0.5}, {1, 0.5, 0.5}), {x, y}},
      {"EF, parallel over a border", EE, ground, blade({-1, 2, 0.5}, {1, 2, 0.5}), {y}},
      {"EF, over a fold", EF, roof(), blade({-1, 0.25, 0.5}, {1, 0.25, 0.5}), {x, y}},
      {"VF, an edge along a fold", VF, roof(), blade({0, -0.5, 0.5}, {0, 0.5, 0.5}), {x, y}},
      {"FF, fold over fold", FF, roof(), valley, {x, y}},
      {"FF, parallel", FF, ground, quad({-1, -1, 0.5}, {-1, 1, 0.5}, {3, 1, 0.5}, {3, -1, 0.5}), {x, y}},
  };
}

/// Nothing, one unit in the last place, and 1e-12 to either side.
const std::vector<double> nudges{0, 0x1p-52, -0x1p-52, 1e-12, -1e-12};

void check(const Body& a, const Body& b, double threshold, std::size_t& contacts) {
  const Comparison comparison = compare(a, b, threshold);
  contacts += comparison.contacts;
  CHECK(comparison.difference == "");
}

}  // namespace

TEST_CASE("kernels: each closest feature at the threshold and at its changes of kind") {
  std::size_t contacts = 0;
  for (const Case& scene : cases()) {
    SECTION(scene.name) {
      const oracle::Pair distance = oracle::surface_distance(scene.a, scene.b);
      REQUIRE(distance.distance_down == 0.5);
      REQUIRE(distance.distance_up == 0.5);
      const auto closest = oracle::closest(scene.a, scene.b, 1);
      REQUIRE(closest.has_value());
      CHECK(closest->kind == scene.closest);
      CHECK(detect(surface_of(scene.a), surface_of(scene.b), query_of(ContactDetail::features, 0.5))
                .contacts.empty());
      for (const double above : nudges) {
        const Shape lifted = mapped(scene.b, 1, {0, 0, above});
        for (const double wider : nudges) check(scene.a, lifted, 0.5 + wider, contacts);
      }
      for (const Vector3d& along : scene.changes) {
        for (const double aside : nudges) {
          const Shape moved = mapped(scene.b, 1, along * aside);
          check(scene.a, moved, 0.75, contacts);
          check(scene.a, moved, 0.5, contacts);
          check(moved, scene.a, 0.75, contacts);
        }
      }
      CHECK(contacts > 0);
    }
  }
}

/// An area thinner than rounding has a middle somewhere in it: the points are checked for lying in the
/// closest set, and everything else as always.
void check_thin_overlap(const Shape& a, const Shape& b, double threshold, std::size_t& contacts) {
  const Tolerance tolerance(a, b);
  const auto expected = oracle::features(a, b, threshold);
  CHECK(difference_of(
            detect(surface_of(a), surface_of(b), query_of(ContactDetail::features, threshold)).contacts,
            expected, tolerance) == "");
  const auto closest = oracle::closest(a, b, threshold);
  const PairAnswer answer = detect(surface_of(a), surface_of(b), query_of(ContactDetail::closest, threshold));
  REQUIRE(answer.contacts.size() == (closest ? 1U : 0U));
  contacts += expected.size() + answer.contacts.size();
  if (!closest) return;
  const Contact& contact = answer.contacts[0];
  CHECK(contact.kind == closest->kind);
  CHECK(contact.feature_a == closest->a);
  CHECK(contact.feature_b == closest->b);
  const double error = tolerance.of(closest->a, closest->b, closest->distance);
  CHECK(std::abs(contact.distance - closest->distance) <= error);
  CHECK(std::abs((contact.point_b - contact.point_a).norm() - closest->distance) <= error);
  CHECK(std::abs(contact.point_a.x() - 2) <= 1.1e-12);
  CHECK(std::abs(contact.point_a.y()) <= 1);
}

TEST_CASE("kernels: parallel faces with an overlap as thin as rounding") {
  const Shape ground = quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  const Shape beside = quad({2, -1, 0.5}, {2, 1, 0.5}, {4, 1, 0.5}, {4, -1, 0.5});
  std::size_t contacts = 0;
  for (const double nudge : nudges)
    check_thin_overlap(ground, mapped(beside, 1, {nudge, 0, 0}), 0.75, contacts);
  for (std::size_t vertex = 0; vertex < beside.positions.size(); ++vertex)
    for (int axis = 0; axis < 3; ++axis)
      for (const double nudge : {0x1p-52, -0x1p-52}) {
        Shape moved = beside;
        moved.positions[vertex][axis] += nudge;
        check_thin_overlap(ground, moved, std::nextafter(0.5, 1), contacts);
      }
  CHECK(contacts > 50);
}

TEST_CASE("kernels: a move along each coordinate of each vertex by a unit in the last place") {
  std::size_t contacts = 0;
  for (const Case& scene : cases()) {
    INFO(scene.name);
    for (std::size_t vertex = 0; vertex < scene.b.positions.size(); ++vertex)
      for (int axis = 0; axis < 3; ++axis)
        for (const double nudge : {0x1p-52, -0x1p-52}) {
          Shape moved = scene.b;
          moved.positions[vertex][axis] += nudge;
          check(scene.a, moved, 0.5, contacts);
          check(scene.a, moved, std::nextafter(0.5, 1), contacts);
        }
  }
  CHECK(contacts > 900);
  std::cout << "compared " << contacts << " contacts beside a change of kind\n";
}

}  // namespace graze::tests
