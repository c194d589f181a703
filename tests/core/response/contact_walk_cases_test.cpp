// This test follows single contacts: around a border, through a surface, over the edge of a box, and through
// the cases where the answer is not known.

#include <algorithm>
#include <cmath>
#include <graze/contact_walk.hpp>
#include <limits>

#include "core/placed_shape.hpp"
#include "core/shapes.hpp"
#include "models/models.hpp"
#include "support/catch.hpp"
#include "support/model_shape.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

FollowedContact follow_now(const Placed& a, const Placed& b, const Contact& contact) {
  return follow(*a.mesh, a.shape.positions, *b.mesh, b.shape.positions, contact);
}

/// A pin that points down. Its tip is vertex 0.
Placed pin_at(const Vector3d& tip) {
  return Placed(triangle(tip, tip + Vector3d(0.1, 0, 2), tip + Vector3d(-0.1, 0.1, 2)));
}

Placed sheet_of_cells() {
  return Placed(shape_of(models::sheet(8, 8, 2, 2)));
}

/// The contact of a pin's tip, where the pin is b.
Contact contact_of_tip(const Placed& a, const Placed& pin, double threshold = 0.3,
                       const oracle::Solids& solids = {}) {
  const auto contacts = contacts_of(a, pin, ContactDetail::nearest, threshold, solids).contacts;
  // Vertices of the surface have contacts with the tip, too, that are further apart.
  const auto distance = [](const Contact& contact) {
    const bool is_of_tip = contact.feature_b == Feature{FeatureKind::vertex, 0};
    return is_of_tip ? contact.distance : 1e9;
  };
  const auto found = std::min_element(
      contacts.begin(), contacts.end(),
      [&](const Contact& one, const Contact& other) { return distance(one) < distance(other); });
  REQUIRE(found != contacts.end());
  REQUIRE(found->feature_b == Feature{FeatureKind::vertex, 0});
  return *found;
}

void check_unmoved(const Placed& a, const Placed& b, const Contact& contact) {
  const FollowedContact found = follow_now(a, b, contact);
  const ContactGeometry stays = evaluate(a, b, contact);
  CHECK_FALSE(found.is_known);
  CHECK(found.feature_a == contact.feature_a);
  CHECK(found.feature_b == contact.feature_b);
  CHECK(found.geometry.point_a == stays.point_a);
  CHECK(found.geometry.separation == stays.separation);
  CHECK(found.geometry.push == stays.push);
}

}  // namespace

TEST_CASE("follow: a tip that goes over a sheet is on the cells that it passes") {
  const Placed sheet = sheet_of_cells();
  const Placed pin = pin_at({-0.85, 0.1, 0.05});
  const Contact contact = contact_of_tip(sheet, pin);
  for (int step = 0; step <= 170; ++step) {
    const double x = -0.85 + 0.01 * step;
    const FollowedContact found = follow_now(sheet, pin_at({x, 0.1, 0.05 - 0.0006 * step}), contact);
    CAPTURE(step, found.steps);
    CHECK(found.is_known);
    CHECK(std::abs(found.geometry.separation - (0.05 - 0.0006 * step)) < 1e-12);
    CHECK(std::abs(found.geometry.point_a.x() - x) < 1e-12);
    CHECK((found.geometry.push - Vector3d(0, 0, 1)).norm() < 1e-12);
    if (step == 170) CHECK(found.steps >= 6);
    if (step == 170) CHECK(found.geometry.side_a == Side::back);
  }
}

TEST_CASE("follow: a tip on the surface has distance 0 and the push of the report") {
  const Placed sheet = sheet_of_cells();
  const Contact contact = contact_of_tip(sheet, pin_at({0.06, 0.04, 0.05}));
  for (const Vector3d& tip : {Vector3d(0.07, 0.04, 0), Vector3d(0.3, 0.04, 0), Vector3d(0.25, 0.04, 0)}) {
    const FollowedContact found = follow_now(sheet, pin_at(tip), contact);
    CHECK(found.is_known);
    CHECK(found.geometry.separation == 0);
    CHECK((found.geometry.push - Vector3d(0, 0, 1)).norm() < 1e-12);
  }
}

TEST_CASE("follow: beside a border the distance is known, and a side that changes there is not") {
  const Placed sheet = sheet_of_cells();
  const Contact contact = contact_of_tip(sheet, pin_at({0.95, 0.1, 0.05}));
  const FollowedContact beside = follow_now(sheet, pin_at({1.04, 0.1, 0.03}), contact);
  CHECK(beside.is_known);
  CHECK(std::abs(beside.geometry.separation - 0.05) < 1e-12);
  CHECK(beside.feature_a.kind == FeatureKind::edge);
  CHECK((beside.geometry.push - Vector3d(0.8, 0, 0.6)).norm() < 1e-12);
  check_unmoved(sheet, pin_at({1.04, 0.1, -0.03}), contact);
  const Contact at_border = contact_of_tip(sheet, pin_at({1.04, 0.1, 0.03}));
  check_unmoved(sheet, pin_at({0.96, 0.1, -0.03}), at_border);
  const FollowedContact over = follow_now(sheet, pin_at({0.96, 0.1, 0.03}), at_border);
  CHECK(over.is_known);
  CHECK(std::abs(over.geometry.separation - 0.03) < 1e-12);
}

TEST_CASE("follow: a tip goes over the edge of a box, and into it, without a jump") {
  const Placed block(box({-1, -1, -1}, {2, 2, 1}));
  const Contact contact = contact_of_tip(block, pin_at({0.9, 0.05, 0.05}), 0.3, {true, false});
  double last = contact.separation();
  for (int step = 1; step <= 100; ++step) {
    const Vector3d tip(0.9 + 0.002 * step, 0.05,
                       0.05 - 0.002 * step);  // over the top, beside the edge, beside
    const FollowedContact found = follow_now(block, pin_at(tip), contact);
    CHECK(found.is_known);
    CHECK(std::abs(found.geometry.separation - last) < 0.003);
    last = found.geometry.separation;
  }
  CHECK(std::abs(last - 0.1) < 1e-12);
  const FollowedContact inside = follow_now(block, pin_at({0.97, 0.05, -0.2}), contact);
  CHECK(inside.is_known);
  CHECK(std::abs(inside.geometry.separation + 0.03) < 1e-12);
  CHECK((inside.geometry.push - Vector3d(1, 0, 0)).norm() < 1e-12);
}

TEST_CASE("follow: a solid that is wound inside out keeps its sign over an edge") {
  Shape inverse = box({-1, -1, -1}, {2, 2, 1});
  for (auto& face : inverse.faces) std::reverse(face.begin(), face.end());
  const Placed block(inverse);
  const Contact contact = contact_of_tip(block, pin_at({0.9, 0.05, 0.05}), 0.3, {true, false});
  REQUIRE(contact.separation() > 0);
  const FollowedContact inside = follow_now(block, pin_at({0.97, 0.05, -0.2}), contact);
  CHECK(inside.is_known);
  CHECK(std::abs(inside.geometry.separation + 0.03) < 1e-12);
  const FollowedContact beside = follow_now(block, pin_at({1.02, 0.05, -0.2}), contact);
  CHECK(beside.is_known);
  CHECK(std::abs(beside.geometry.separation - 0.02) < 1e-12);
}

TEST_CASE("follow: a contact of two vertices parts into that of either one") {
  const Placed block(box({-1, -1, -1}, {1, 1, 1}));  // its corner is at the origin
  const Placed other(box({0.05, 0.05, 0.05}, {1, 1, 1}));
  const auto contacts = contacts_of(block, other, ContactDetail::nearest, 0.2, {true, true}).contacts;
  REQUIRE(contacts.size() == 1);
  REQUIRE(contacts[0].kind == ContactKind::VV);
  const Placed slid(mapped(other.shape, 1, {-0.2, -0.3, 0.02}));
  const FollowedContact of_a = follow_now(block, slid, contacts[0]);
  const FollowedContact of_b =
      follow_vertex_of_b(*block.mesh, block.shape.positions, *slid.mesh, slid.shape.positions, contacts[0]);
  CHECK(of_a.is_known);
  CHECK(of_b.is_known);
  CHECK(of_a.feature_a == contacts[0].feature_a);
  CHECK(of_a.feature_b.kind == FeatureKind::face);
  CHECK(of_b.feature_b == contacts[0].feature_b);
  CHECK(of_b.feature_a.kind == FeatureKind::face);
  CHECK(std::abs(of_a.geometry.separation - 0.07) < 1e-12);
  CHECK(std::abs(of_b.geometry.separation - 0.07) < 1e-12);
}

TEST_CASE("follow: an edge that pierces moves on to the face that it pierces now") {
  const Placed sheet = sheet_of_cells();
  const Placed pin = pin_at({0.06, 0.04, -0.5});
  std::size_t followed = 0;
  for (const Contact& contact : contacts_of(sheet, pin, ContactDetail::nearest, 0.1).contacts) {
    if (contact.kind != ContactKind::EF) continue;
    const FollowedContact found = follow_now(sheet, pin_at({0.3, 0.04, -0.5}), contact);
    CHECK(found.is_known);
    CHECK(found.feature_a != contact.feature_a);
    CHECK(found.geometry.separation == 0);
    CHECK(found.geometry.push == contact.push());
    check_unmoved(sheet, pin_at({0.06, 0.04, 0.5}), contact);
    ++followed;
  }
  CHECK(followed == 2);
}

TEST_CASE("follow: after too many steps the answer is not known") {
  const Placed sheet(shape_of(models::sheet(200, 2, 20, 0.2)));
  const Contact contact = contact_of_tip(sheet, pin_at({-9.95, 0.01, 0.05}));
  CHECK(follow_now(sheet, pin_at({-9, 0.01, 0.05}), contact).is_known);
  check_unmoved(sheet, pin_at({9, 0.01, 0.05}), contact);
}

TEST_CASE("follow: on any surface the answer is no further than that of evaluate()") {
  std::size_t nearer = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    const Placed now_a(wobbled(scene.a, 0.1, seed));
    const Placed now_b(mapped(scene.b, 1.05, {0.05, -0.02, 0.03}));
    for (const Contact& contact : contacts_of(a, b, ContactDetail::features).contacts) {
      const FollowedContact found = follow_now(now_a, now_b, contact);
      const ContactGeometry stays = evaluate(now_a, now_b, contact);
      CHECK(found.geometry.distance <= stays.distance * (1 + 1e-12));
      if (found.is_known) CHECK(found.geometry.is_interior);
      if (found.is_known) CHECK(std::abs(found.geometry.separation) == found.geometry.distance);
      nearer += found.geometry.distance < 0.99 * stays.distance ? 1U : 0U;
    }
  }
  CHECK(nearer > 100);
}

TEST_CASE("follow: of one surface with itself a walk that comes to its own vertex is not known") {
  const Placed sheet = sheet_of_cells();
  Contact contact;  // of a folded sheet that is flat by now
  contact.kind = ContactKind::VF;
  contact.feature_a = {FeatureKind::vertex, 40};
  contact.normal = {0, 0, 1};
  contact.distance = 0.1;
  std::size_t moved_on = 0;
  for (std::uint32_t face = 0; face < sheet.mesh->face_count(); ++face) {
    contact.feature_b = {FeatureKind::face, face};
    check_unmoved(sheet, sheet, contact);
    moved_on += evaluate(sheet, sheet, contact).distance > 0 ? 1U : 0U;
  }
  CHECK(moved_on > 50);
}

TEST_CASE("follow: positions that are not finite are no known answer") {
  const Placed sheet = sheet_of_cells();
  Placed pin = pin_at({0.06, 0.04, 0.05});
  const Contact contact = contact_of_tip(sheet, pin);
  CHECK(follow_now(sheet, pin, contact).is_known);
  pin.shape.positions[0].x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(follow_now(sheet, pin, contact).is_known);
}

TEST_CASE("follow: contacts of folds and parallel faces stay with their features") {
  Contact contact;
  contact.kind = ContactKind::FF;
  contact.feature_a = {FeatureKind::face, 0};
  contact.feature_b = {FeatureKind::face, 0};
  contact.normal = {0, 0, 1};
  contact.distance = 0.1;
  const Placed lower = sheet_of_cells();
  check_unmoved(lower, moved(lower, {0, 0, 0.1}), contact);
}

TEST_CASE("follow: a contact of another mesh is refused") {
  const Placed one(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  Contact contact;
  contact.feature_b = {FeatureKind::face, 7};
  CHECK_THROWS_WITH(follow_now(one, one, contact), "follow: the mesh has no face 7");
  const std::vector<Vector3d> two{{0, 0, 0}, {1, 0, 0}};
  CHECK_THROWS_AS(follow(*one.mesh, two, *one.mesh, one.shape.positions, Contact()), Error);
}

}  // namespace graze::tests
