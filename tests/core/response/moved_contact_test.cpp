// This test follows contacts to other positions with both forms of evaluate(): the side and the push of two
// edges, sunk pairs by exact arithmetic, and signs that go through zero when bodies move through each other.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/placed_shape.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/exact/exact_distance.hpp"
#include "support/random/random_scenes.hpp"
#include "support/random/random_solids.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

bool are_edges(const Contact& contact) {
  return contact.feature_a.kind == FeatureKind::edge && contact.feature_b.kind == FeatureKind::edge;
}

/// Whether an edge passes through any face of another shape, in exact arithmetic.
bool pierces_some_face(const oracle::ExactShape& shape, std::uint32_t edge, const oracle::ExactShape& other,
                       const Shape& other_shape) {
  for (std::uint32_t face = 0; face < other_shape.faces.size(); ++face)
    if (oracle::crossing(shape, shape.segments[edge], other, face)) return true;
  return false;
}

/// A box on a box, turned about the upright axis, and tilted by a little. The upper one is b.
Placed upper_box(const Vector3d& half, double turn, double height) {
  Shape shape = box(-half, 2 * half);
  const Eigen::AngleAxisd about(turn, Vector3d::UnitZ());
  const Eigen::AngleAxisd tilt(1e-3, Vector3d(1, 0.6, 0).normalized());
  for (Vector3d& position : shape.positions) position = tilt * (about * position) + Vector3d(0, 0, height);
  return Placed(shape);
}

/// What a contact says, and what a geometry says of it at the positions of its report.
void check_itself(const ContactGeometry& now, const Contact& contact) {
  CAPTURE(static_cast<int>(contact.kind), contact.feature_a.index, contact.feature_b.index, contact.distance,
          static_cast<int>(contact.side_a), static_cast<int>(contact.side_b), contact.sunk);
  CHECK(std::abs(now.separation - contact.separation()) < 1e-9);
  CHECK((now.push - contact.push()).norm() < 1e-6);
  CHECK(now.side_a == contact.side_a);
  CHECK(now.side_b == contact.side_b);
  CHECK(now.sunk == (are_edges(contact) && contact.separation() < 0));
}

/// Whether a contact's points, push and sides do not hang on rounding.
bool is_clear(const Contact& contact) {
  const bool is_anywhere = contact.kind == ContactKind::EF || contact.kind == ContactKind::FF;
  return contact.distance > 1e-6 && !is_anywhere && contact.side_a != Side::none &&
         contact.side_b != Side::none;
}

}  // namespace

TEST_CASE("evaluate: at the positions of its report a contact has its separation, push, sides and sunk") {
  std::size_t compared = 0;
  std::size_t sunk = 0;
  std::size_t behind = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    CAPTURE(seed);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    for (const ContactDetail detail : {ContactDetail::nearest, ContactDetail::features})
      for (const Contact& contact : contacts_of(a, b, detail).contacts) {
        if (!is_clear(contact)) continue;
        check_itself(evaluate(a, contact.feature_a, b, contact.feature_b), contact);
        check_itself(evaluate(a, b, contact), contact);
        ++compared;
        sunk += contact.sunk ? 1U : 0U;
        behind += contact.separation() < 0 && !contact.sunk ? 1U : 0U;
      }
  }
  std::cout << "compared " << compared << " contacts, " << sunk << " of them sunk, and " << behind
            << " others behind a surface\n";
  CHECK(compared > 5000);
  CHECK(sunk > 100);
  CHECK(behind > 100);
}

TEST_CASE("evaluate: a contact of a solid keeps the side that its winding number gives") {
  std::size_t against = 0;  // of the normals
  for (std::uint64_t seed = 0; seed < 400; seed += 2) {
    CAPTURE(seed);
    const oracle::RandomSolids scene = oracle::random_solids(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    for (const Contact& contact :
         contacts_of(a, b, ContactDetail::nearest, scene.threshold, scene.solids).contacts) {
      if (!is_clear(contact)) continue;
      check_itself(evaluate(a, b, contact), contact);
      const double by_normals = evaluate(a, contact.feature_a, b, contact.feature_b).separation;
      if (by_normals * contact.separation() < 0) ++against;
    }
  }
  std::cout << "the winding number contradicts the normals in " << against << " contacts\n";
  CHECK(against > 50);
}

TEST_CASE("evaluate: two edges are sunk if both are behind and one pierces, as in exact arithmetic") {
  std::size_t sunk = 0;
  std::size_t only_behind = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    const oracle::ExactShape exact_a(scene.a);
    const oracle::ExactShape exact_b(scene.b);
    for (std::uint32_t i = 0; i < a.mesh->edge_count(); ++i)
      for (std::uint32_t j = 0; j < b.mesh->edge_count(); ++j) {
        const ContactGeometry found = evaluate(a, {FeatureKind::edge, i}, b, {FeatureKind::edge, j});
        const bool is_behind = found.side_a == Side::back && found.side_b == Side::back;
        if (!is_behind) {
          REQUIRE_FALSE(found.sunk);
          REQUIRE(found.separation == found.distance);
          continue;
        }
        const bool pierces = pierces_some_face(exact_a, i, exact_b, scene.b) ||
                             pierces_some_face(exact_b, j, exact_a, scene.a);
        CAPTURE(i, j);
        REQUIRE(found.sunk == pierces);
        REQUIRE(found.separation == (pierces ? -found.distance : found.distance));
        REQUIRE(found.push == (pierces ? Vector3d(-found.normal) : found.normal));
        ++(pierces ? sunk : only_behind);
      }
  }
  std::cout << sunk << " pairs of edges are sunk, " << only_behind << " only behind each other\n";
  CHECK(sunk > 500);
  CHECK(only_behind > 500);
}

TEST_CASE("evaluate: edges of thin plates that lie apart are behind each other, and not sunk") {
  const Vector3d half(0.4, 0.2, 0.005);
  const Placed lower(box(-half, 2 * half));
  const Placed upper = upper_box(half, 1.3, 0.015);
  std::size_t behind = 0;
  for (std::uint32_t i = 0; i < lower.mesh->edge_count(); ++i)
    for (std::uint32_t j = 0; j < upper.mesh->edge_count(); ++j) {
      const ContactGeometry found = evaluate(lower, {FeatureKind::edge, i}, upper, {FeatureKind::edge, j});
      if (found.side_a == Side::back && found.side_b == Side::back) ++behind;
      CHECK_FALSE(found.sunk);
      CHECK(found.separation == found.distance);
    }
  CHECK(behind > 4);
  for (const ContactDetail detail : {ContactDetail::nearest, ContactDetail::features})
    for (const Contact& contact : contacts_of(lower, upper, detail, 0.05).contacts)
      if (are_edges(contact)) CHECK_FALSE(evaluate(lower, upper, contact).sunk);
}

TEST_CASE("evaluate: a contact goes through zero when a crate is moved in and out") {
  const Vector3d half(0.25, 0.25, 0.25);
  const Placed lower(box(-half, 2 * half));
  std::size_t followed = 0;
  for (const double gap : {0.005, -0.005}) {
    const Placed upper = upper_box(half, 0.785, 0.5 + gap);
    for (const Contact& contact : contacts_of(lower, upper, ContactDetail::nearest, 0.02).contacts) {
      if (contact.distance == 0 || contact.push().z() < 0.9) continue;
      CAPTURE(gap, static_cast<int>(contact.kind), contact.feature_a.index, contact.feature_b.index);
      for (int step = -20; step <= 20; ++step) {
        const double rise = step * 0.001;
        const ContactGeometry now = evaluate(lower, moved(upper, rise * contact.push()), contact);
        CHECK(std::abs(now.separation - (contact.separation() + rise)) < 1e-12);
        CHECK((now.push - contact.push()).norm() < 1e-6);
        CHECK((now.point_b - now.point_a - now.separation * now.push).norm() < 1e-12);
        const bool has_passed = (now.separation < 0) != (contact.separation() < 0);
        CHECK((now.side_a == contact.side_a) == !has_passed);
        CHECK((now.side_b == contact.side_b) == !has_passed);
        CHECK(now.sunk == (are_edges(contact) && now.separation < 0));
      }
      ++followed;
    }
  }
  CHECK(followed > 12);
}

TEST_CASE("evaluate: a contact of edges that touch goes on to both sides") {
  const Placed ridge(triangle({-1, 0, 0}, {1, 0, 0}, {0, 0.5, -1}));
  const Placed bar(triangle({0, -1, 0}, {0, 1, 0}, {0.5, 0, 1}));
  const auto contacts = contacts_of(ridge, bar, ContactDetail::features).contacts;
  const auto touching = std::find_if(contacts.begin(), contacts.end(), [](const Contact& contact) {
    return contact.kind == ContactKind::EE && contact.distance == 0;
  });
  REQUIRE(touching != contacts.end());
  const ContactGeometry at_report = evaluate(ridge, bar, *touching);
  CHECK(at_report.separation == 0);
  CHECK_FALSE(std::signbit(at_report.separation));
  CHECK_FALSE(at_report.sunk);
  CHECK(at_report.push == touching->push());
  for (const double rise : {0.25, -0.25}) {
    const ContactGeometry now = evaluate(ridge, moved(bar, rise * touching->push()), *touching);
    CHECK(now.separation == rise);
    CHECK(now.push == touching->push());
    CHECK(now.sunk == (rise < 0));
    CHECK(now.side_a == Side::none);
  }
}

TEST_CASE("evaluate: edges that are parallel by now have the direction of their gap, and the report's sign") {
  const Placed lower(triangle({-1, 0, 0}, {1, 0, 0}, {0, 1, -1}));
  const Placed across(triangle({-0.5, -1, 0.25}, {0.5, 1, 0.25}, {0, 0, 1}));
  const auto contacts = contacts_of(lower, across, ContactDetail::features).contacts;
  const auto found = std::find_if(contacts.begin(), contacts.end(), are_edges);
  REQUIRE(found != contacts.end());
  REQUIRE(found->push() == Vector3d(0, 0, 1));
  const auto parallel_at = [](const Vector3d& offset) {
    return Placed(triangle(Vector3d(-0.5, 0, 0) + offset, Vector3d(0.5, 0, 0) + offset, {0, 0, 1}));
  };
  REQUIRE(parallel_at({0, 0, 0}).mesh->edge(found->feature_b.index) ==
          across.mesh->edge(found->feature_b.index));
  const ContactGeometry above = evaluate(lower, parallel_at({0, 0.125, 0.125}), *found);
  CHECK((above.push - Vector3d(0, 1, 1).normalized()).norm() < 1e-15);
  CHECK(above.separation == above.distance);
  const ContactGeometry below = evaluate(lower, parallel_at({0, 0, -0.125}), *found);
  CHECK(below.push == Vector3d(0, 0, 1));
  CHECK(below.separation == -0.125);
  CHECK(below.sunk);
  const ContactGeometry touching = evaluate(lower, parallel_at({0, 0, 0}), *found);
  CHECK(touching.separation == 0);
  CHECK(std::abs(touching.push.norm() - 1) < 1e-15);
  CHECK(touching.push.z() >= 0);
}

TEST_CASE("evaluate: beside their features a contact's separation is that of the plane or of the lines") {
  const Placed floor(quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}));
  const Placed pin(triangle({0.5, 0, 0.25}, {0.5, 1, 3}, {0.5, -1, 3}));
  const auto contacts = contacts_of(floor, pin, ContactDetail::nearest).contacts;
  REQUIRE(contacts.size() == 1);
  REQUIRE(contacts[0].push() == Vector3d(0, 0, 1));
  const ContactGeometry beside = evaluate(floor, moved(pin, {4, 0, -0.5}), contacts[0]);
  CHECK_FALSE(beside.is_interior);
  CHECK(beside.separation == -0.25);
  CHECK(beside.distance > 2.5);
  CHECK(beside.push == Vector3d(0, 0, 1));

  const Placed ridge(triangle({-1, 0, 0}, {1, 0, 0}, {0, 0.5, -1}));
  const Placed bar(triangle({0, -1, 0.125}, {0, 1, 0.125}, {0.5, 0, 1}));
  const auto edges = contacts_of(ridge, bar, ContactDetail::features).contacts;
  const auto found = std::find_if(edges.begin(), edges.end(), are_edges);
  REQUIRE(found != edges.end());
  const ContactGeometry along = evaluate(ridge, moved(bar, {3, 0, -0.25}), *found);
  CHECK_FALSE(along.is_interior);
  CHECK(along.separation == -0.125);
  CHECK(along.distance > 2);
}

TEST_CASE("evaluate: an edge that pierced a face and has left it says how far, and where it was") {
  const Placed floor(quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}));
  const Placed pin(triangle({0.5, 0, -0.5}, {0.5, 1, 1}, {0.5, -1, 1}));
  for (const Contact& contact : contacts_of(floor, pin, ContactDetail::nearest).contacts) {
    if (contact.kind != ContactKind::EF) continue;
    CHECK(evaluate(floor, pin, contact).separation == 0);
    CHECK(evaluate(floor, pin, contact).push == Vector3d(0, 0, 1));
    CHECK(evaluate(floor, moved(pin, {0, 0, 1}), contact).separation == 0.5);
    CHECK(evaluate(floor, moved(pin, {0, 0, -2}), contact).separation == -1);
    CHECK(evaluate(floor, moved(pin, {0, 0, -2}), contact).push == Vector3d(0, 0, 1));
  }
}

TEST_CASE("evaluate: a contact of another mesh is refused") {
  const Placed one(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  Contact contact;
  contact.feature_b = {FeatureKind::face, 7};
  CHECK_THROWS_WITH(evaluate(one, one, contact), "evaluate: the mesh has no face 7");
  const std::vector<Vector3d> two{{0, 0, 0}, {1, 0, 0}};
  CHECK_THROWS_AS(graze::evaluate(*one.mesh, two, *one.mesh, one.shape.positions, Contact()), Error);
}

}  // namespace graze::tests
