// This test compares evaluate() and weights() with the exact oracles, and with the contacts that a query
// finds. It also checks the sign of Contact::separation() and the direction of Contact::push().

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <graze/contact_geometry.hpp>
#include <iostream>
#include <limits>

#include "core/placed_shape.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/exact/exact_distance.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

constexpr std::uint64_t seed_count = 600;

/// One feature as a surface of its own: vertices and edges become faces that repeat a corner.
Shape alone(const Placed& of, const Feature& feature) {
  Shape shape{of.shape.positions, {}};
  const std::uint32_t index = feature.index;
  if (feature.kind == FeatureKind::face) {
    shape.faces = {of.shape.faces[index]};
  } else if (feature.kind == FeatureKind::edge) {
    const auto [start, end] = of.mesh->edge(index);
    shape.faces = {{start, end, end}};
  } else {
    shape.faces = {{index, index, index}};
  }
  return shape;
}

std::vector<Feature> features_of(const Placed& of) {
  std::vector<Feature> features;
  for (std::uint32_t i = 0; i < of.mesh->vertex_count(); ++i)
    if (of.mesh->is_used(i)) features.push_back({FeatureKind::vertex, i});
  for (std::uint32_t i = 0; i < of.mesh->edge_count(); ++i) features.push_back({FeatureKind::edge, i});
  for (std::uint32_t i = 0; i < of.mesh->face_count(); ++i) features.push_back({FeatureKind::face, i});
  return features;
}

/// Whether the closest points of a vertex and something, or of two edges, are inside both, for generic
/// positions.
bool is_interior(const Placed& a, const Feature& feature_a, const Placed& b, const Feature& feature_b) {
  if (feature_a.kind > feature_b.kind) return is_interior(b, feature_b, a, feature_a);
  const oracle::ExactShape exact_a(a.shape);
  const oracle::ExactShape exact_b(b.shape);
  if (feature_a.kind == FeatureKind::edge && feature_b.kind == FeatureKind::edge)
    return oracle::inner_contact(exact_a, exact_a.segments[feature_a.index], exact_b,
                                 exact_b.segments[feature_b.index])
        .has_value();
  if (feature_b.kind == FeatureKind::vertex) return true;
  const oracle::Point point = exact_a.points[feature_a.index];
  const oracle::Foot foot = feature_b.kind == FeatureKind::edge
                                ? oracle::foot_on_segment(point, exact_b, exact_b.segments[feature_b.index])
                                : oracle::foot_on_face(point, exact_b, feature_b.index);
  return foot.feature == feature_b;
}

/// Parallel edges are closest all along each other, which the oracle does not call an inner contact.
bool are_parallel(const Placed& a, const Feature& feature_a, const Placed& b, const Feature& feature_b) {
  if (feature_a.kind != FeatureKind::edge || feature_b.kind != FeatureKind::edge) return false;
  const auto direction = [](const Placed& of, std::uint32_t edge) {
    const auto [start, end] = of.mesh->edge(edge);
    return Vector3d((of.shape.positions[end] - of.shape.positions[start]).normalized());
  };
  return direction(a, feature_a.index).cross(direction(b, feature_b.index)).norm() < 1e-9;
}

void check_pair(const Placed& a, const Feature& feature_a, const Placed& b, const Feature& feature_b,
                bool is_generic) {
  const ContactGeometry found = evaluate(a, feature_a, b, feature_b);
  const double distance = oracle::surface_distance(alone(a, feature_a), alone(b, feature_b)).distance_up;
  CAPTURE(static_cast<int>(feature_a.kind), feature_a.index, static_cast<int>(feature_b.kind),
          feature_b.index, found.distance, distance);
  const int dimensions = static_cast<int>(feature_a.kind) + static_cast<int>(feature_b.kind);
  if (dimensions > 2 && found.is_interior)  // at the fold of a quad, where other points may be nearer
    CHECK(found.distance > distance - 1e-9);
  else
    CHECK(std::abs(found.distance - distance) < 1e-9);
  CHECK(std::abs((found.point_b - found.point_a).norm() - found.distance) < 1e-9);
  CHECK(std::abs(found.normal.norm() - 1) < 1e-12);
  CHECK(std::abs(found.separation) == found.distance);
  if (found.distance > 1e-6)
    CHECK((found.point_b - found.point_a - found.normal * found.distance).norm() < 1e-9);
  if (is_generic && dimensions <= 2 && distance > 1e-9 && !are_parallel(a, feature_a, b, feature_b))
    CHECK(found.is_interior == is_interior(a, feature_a, b, feature_b));
  const ContactGeometry other = evaluate(b, feature_b, a, feature_a);
  CHECK(std::abs(other.separation - found.separation) < 1e-9);
}

/// Every contact's geometry at its own positions is the contact.
/// `is_exact` says that surfaces touch exactly, as they do on a grid. Which points of faces are closest is
/// left to rounding then.
void check_contact(const Placed& a, const Placed& b, const Contact& contact, bool is_exact) {
  if (is_exact && contact.kind == ContactKind::FF) return;
  const ContactGeometry found = evaluate(a, contact.feature_a, b, contact.feature_b);
  CAPTURE(static_cast<int>(contact.kind), contact.feature_a.index, contact.feature_b.index, contact.distance,
          static_cast<int>(contact.side_a), static_cast<int>(contact.side_b));
  CHECK(std::abs(found.distance - contact.distance) < 1e-9);
  if (contact.distance < 1e-6) return;
  // Faces that are parallel to something are closest all along it.
  const bool is_anywhere = contact.kind == ContactKind::EF || contact.kind == ContactKind::FF;
  if (!is_anywhere) {
    CHECK(found.is_interior);
    CHECK((found.normal - contact.normal).norm() < 1e-6);
    CHECK((found.point_a - contact.point_a).norm() < 1e-6);
    CHECK((found.point_b - contact.point_b).norm() < 1e-6);
  }
  if (contact.side_a != Side::none && contact.side_b != Side::none)
    CHECK(std::abs(found.separation - contact.separation()) < 1e-9);
}

void check_weights(const Placed& of, const Feature& feature, const Vector3d& point) {
  const SurfaceWeights found = weights(*of.mesh, of.shape.positions, feature, point);
  CAPTURE(static_cast<int>(feature.kind), feature.index, point.transpose());
  const Shape self = alone(of, feature);
  CHECK(found.count == (feature.kind == FeatureKind::face ? static_cast<int>(self.faces[0].size())
                                                          : static_cast<int>(feature.kind) + 1));
  Vector3d sum = Vector3d::Zero();
  double total = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(found.count); ++i) {
    CHECK(found.weight[i] >= 0);
    total += found.weight[i];
    sum += found.weight[i] * of.shape.positions[found.vertex[i]];
    const auto& corners = self.faces[0];
    CHECK(std::find(corners.begin(), corners.end(), found.vertex[i]) != corners.end());
  }
  CHECK(std::abs(total - 1) < 1e-12);
  CHECK((sum - point).norm() < 1e-12);
}

}  // namespace

TEST_CASE("evaluate: distances of any two features are those of exact arithmetic") {
  for (std::uint64_t seed = 0; seed < seed_count / 4; ++seed) {
    CAPTURE(seed);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    oracle::Random random(seed);
    const auto features_a = features_of(a);
    const auto features_b = features_of(b);
    for (int i = 0; i < 40; ++i) {
      const Feature& feature_a = features_a[random.below(static_cast<std::uint32_t>(features_a.size()))];
      const Feature& feature_b = features_b[random.below(static_cast<std::uint32_t>(features_b.size()))];
      check_pair(a, feature_a, b, feature_b, !scene.on_grid);
    }
  }
}

TEST_CASE("evaluate: at its own positions a contact is itself, and weights give its points") {
  std::array<std::size_t, 6> seen{};
  for (std::uint64_t seed = 0; seed < seed_count; ++seed) {
    CAPTURE(seed);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    for (const ContactDetail detail : {ContactDetail::closest, ContactDetail::features})
      for (const Contact& contact : contacts_of(a, b, detail).contacts) {
        ++seen[static_cast<std::size_t>(contact.kind)];
        check_contact(a, b, contact, scene.on_grid || scene.placement == oracle::Placement::touching);
        check_weights(a, contact.feature_a, contact.point_a);
        check_weights(b, contact.feature_b, contact.point_b);
      }
  }
  for (const std::size_t count : seen) CHECK(count > 50);
}

TEST_CASE("evaluate: an edge pierces a face where it does so exactly, and not at the border") {
  std::size_t pierced = 0;
  std::size_t at_border = 0;
  for (std::uint64_t seed = 1; seed < 2 * seed_count; seed += 2) {  // on a grid, with quads that are not flat
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    const oracle::ExactShape exact_a(scene.a);
    const oracle::ExactShape exact_b(scene.b);
    for (std::uint32_t edge = 0; edge < a.mesh->edge_count(); ++edge)
      for (std::uint32_t face = 0; face < b.mesh->face_count(); ++face) {
        const auto crossing = oracle::crossing(exact_a, exact_a.segments[edge], exact_b, face);
        const ContactGeometry found = evaluate(a, {FeatureKind::edge, edge}, b, {FeatureKind::face, face});
        const bool is_pierced = found.is_interior && found.distance == 0 && found.point_a == found.point_b;
        CAPTURE(seed, edge, face, found.distance);
        if (crossing) {
          CHECK(is_pierced);
          const Vector3d point = oracle::round(oracle::point_at(exact_a, exact_a.segments[edge], *crossing));
          CHECK((found.point_a - point).norm() < 1e-9);
          ++pierced;
        } else if (found.distance < 1e-12) {
          // It touches the border, or has an end on the face. Only the inner diagonal is inside.
          CHECK((!found.is_interior || b.shape.faces[face].size() == 4));
          at_border += found.is_interior ? 0U : 1U;
        }
      }
  }
  CHECK(pierced > 150);
  CHECK(at_border > 100);
}

TEST_CASE("evaluate: beside the border of a quad that is not flat, its fold is closest") {
  // The edge meets the side from corner 3 to corner 0, where rounding would let it pass inside.
  const Placed upright(triangle({3, 0, 1}, {3, 0, 2}, {0, 0, 1.5}));
  const Placed warped(quad({3, -0.125, 1.875}, {3.125, 0, 1}, {3.125, 1, 1}, {3, 1, 2.125}));
  const ContactGeometry found = evaluate(upright, {FeatureKind::edge, 0}, warped, {FeatureKind::face, 0});
  CHECK(found.distance > 0.0138);
  CHECK(found.distance < 0.0139);
  CHECK(found.is_interior);  // of the contact of the edge and the fold
  CHECK(evaluate(upright, {FeatureKind::edge, 0}, warped, {FeatureKind::edge, 3}).distance < 1e-15);
}

TEST_CASE("evaluate: an edge through a quad that is not flat has the normal of the triangle it pierces") {
  const Placed warped(quad({0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {0, 2, 0}));
  const Feature face{FeatureKind::face, 0};
  for (const Vector3d& at : {Vector3d(1.5, 0.5, 0), Vector3d(0.5, 1.5, 0), Vector3d(1, 1, 0)}) {
    const Placed bar(triangle(at - 4 * Vector3d::UnitZ(), at + 4 * Vector3d::UnitZ(), {9, 9, 9}));
    const auto contacts = contacts_of(warped, bar, ContactDetail::features).contacts;
    const auto through = std::find_if(contacts.begin(), contacts.end(), [](const Contact& contact) {
      return contact.kind == ContactKind::EF && contact.feature_a.kind == FeatureKind::face &&
             contact.feature_b.index == 0;
    });
    REQUIRE(through != contacts.end());
    const ContactGeometry found = evaluate(warped, face, bar, through->feature_b);
    CHECK(found.distance == 0);
    CHECK((found.normal - through->normal).norm() < 1e-12);
    // Through the fold itself it is the first triangle's.
    const auto& corner = warped.shape.positions;
    const Vector3d first = (corner[1] - corner[0]).cross(Vector3d(corner[2] - corner[0])).normalized();
    CHECK(((found.normal - first).norm() < 1e-12) == (at.x() >= at.y()));
  }
}

TEST_CASE("evaluate: a push makes the separation grow by as much as it moves") {
  constexpr double step = 1e-6;
  std::size_t pushed = 0;
  std::size_t behind = 0;
  for (std::uint64_t seed = 0; seed < seed_count; seed += 2) {  // generic positions
    CAPTURE(seed);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    for (const Contact& contact : contacts_of(a, b, ContactDetail::features).contacts) {
      if (contact.distance < 1e-3 || contact.side_a == Side::none || contact.side_b == Side::none) continue;
      const Placed pushed_b = moved(b, step * contact.push());
      // Of two edges the form with the contact knows which way they go on. They may pierce no longer.
      const ContactGeometry now = contact.kind == ContactKind::EE
                                      ? evaluate(a, pushed_b, contact)
                                      : evaluate(a, contact.feature_a, pushed_b, contact.feature_b);
      CHECK(std::abs(now.separation - contact.separation() - step) < 1e-9);
      ++pushed;
      if (contact.separation() < 0) ++behind;
    }
  }
  std::cout << "pushed " << pushed << " contacts, " << behind << " of them behind a surface\n";
  CHECK(pushed > 1000);
  CHECK(behind > 100);
}

TEST_CASE("separation: a vertex behind a face, two edges, and an edge through a face") {
  const Placed floor(quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}));
  const Feature face{FeatureKind::face, 0};
  const Placed pin(triangle({0.3, 0.1, 0.5}, {0.3, 1.1, 3}, {0.3, -0.9, 3}));
  const Feature tip{FeatureKind::vertex, 0};
  const auto separation = [&](double height) {
    const ContactGeometry found = evaluate(floor, face, moved(pin, {0, 0, height - 0.5}), tip);
    CHECK(found.is_interior);
    CHECK(found.normal.isApprox(Vector3d(0, 0, height < 0 ? -1 : 1)));
    return found.separation;
  };
  CHECK(separation(0.25) == 0.25);
  CHECK(separation(0) == 0);
  CHECK(separation(-0.25) == -0.25);
  CHECK(separation(-0x1p-40) == -0x1p-40);
  CHECK_FALSE(evaluate(floor, face, moved(pin, {5, 0, 0}), tip).is_interior);

  const Feature side{FeatureKind::edge, 0};  // from the tip up
  const ContactGeometry through = evaluate(floor, face, moved(pin, {0, 0, -1}), side);
  CHECK(through.is_interior);
  CHECK(through.separation == 0);
  CHECK(through.normal == Vector3d(0, 0, 1));  // b leaves a along a's face
  CHECK(evaluate(moved(pin, {0, 0, -1}), side, floor, face).normal == Vector3d(0, 0, -1));
  CHECK_FALSE(evaluate(floor, face, pin, side).is_interior);
  CHECK(evaluate(floor, face, pin, side).separation == 0.5);
}

TEST_CASE("separation: which side counts, by kind") {
  const auto contact_of = [](FeatureKind a, FeatureKind b, Side side_a, Side side_b, bool sunk = false) {
    Contact contact;
    contact.sunk = sunk;
    contact.feature_a.kind = a;
    contact.feature_b.kind = b;
    contact.side_a = side_a;
    contact.side_b = side_b;
    contact.distance = 0.5;
    contact.normal = Vector3d(0, 0, 1);
    CHECK(contact.push() == Vector3d(0, 0, contact.separation() < 0 ? -1 : 1));
    return contact.separation();
  };
  using enum FeatureKind;
  constexpr Side back = Side::back;
  constexpr Side front = Side::front;
  CHECK(contact_of(vertex, face, front, back) == -0.5);
  CHECK(contact_of(vertex, face, back, front) == 0.5);
  CHECK(contact_of(face, vertex, back, front) == -0.5);
  CHECK(contact_of(edge, vertex, front, back) == 0.5);
  CHECK(contact_of(vertex, vertex, back, front) == -0.5);
  CHECK(contact_of(vertex, vertex, front, back) == -0.5);
  CHECK(contact_of(vertex, vertex, Side::none, front) == 0.5);
  CHECK(contact_of(edge, edge, back, back, true) == -0.5);
  CHECK(contact_of(edge, edge, back, back) == 0.5);
  CHECK(contact_of(edge, edge, back, front) == 0.5);
  Contact touching;
  touching.normal = Vector3d(0, 0, 1);
  touching.side_a = touching.side_b = back;
  CHECK_FALSE(std::signbit(touching.separation()));
  CHECK(touching.push() == Vector3d(0, 0, 1));
  // Where an edge pierces, the side of the pierced object turns the push, and nothing else does.
  const auto push_of = [&](FeatureKind a, FeatureKind b, Side side_a, Side side_b) {
    touching.kind = ContactKind::EF;
    touching.feature_a.kind = a;
    touching.feature_b.kind = b;
    touching.side_a = side_a;
    touching.side_b = side_b;
    CHECK(touching.separation() == 0);
    CHECK_FALSE(std::signbit(touching.separation()));
    return touching.push().z();
  };
  CHECK(push_of(face, edge, Side::none, Side::none) == 1);
  CHECK(push_of(face, edge, back, Side::none) == -1);
  CHECK(push_of(face, edge, Side::none, back) == 1);
  CHECK(push_of(edge, face, Side::none, back) == -1);
  CHECK(push_of(edge, face, back, Side::none) == 1);
}

TEST_CASE("evaluate and weights refuse features that a mesh has not, and positions of another mesh") {
  const Placed one(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  const Feature corner{FeatureKind::vertex, 0};
  for (const Feature& wrong : {Feature{FeatureKind::vertex, 3}, Feature{FeatureKind::edge, 3},
                               Feature{FeatureKind::face, 1}, Feature{static_cast<FeatureKind>(7), 0}}) {
    CHECK_THROWS_AS(evaluate(one, wrong, one, corner), Error);
    CHECK_THROWS_AS(evaluate(one, corner, one, wrong), Error);
    CHECK_THROWS_AS(weights(*one.mesh, one.shape.positions, wrong, {0, 0, 0}), Error);
  }
  const std::vector<Vector3d> two{{0, 0, 0}, {1, 0, 0}};
  CHECK_THROWS_AS(weights(*one.mesh, two, corner, {0, 0, 0}), Error);
  CHECK_THROWS_AS(graze::evaluate(*one.mesh, one.shape.positions, corner, *one.mesh, two, corner), Error);
  const PositionView null(static_cast<const double*>(nullptr), 3);
  CHECK_THROWS_WITH(weights(*one.mesh, null, corner, {0, 0, 0}), "weights: the positions are null memory");
  CHECK_THROWS_WITH(evaluate(one, {FeatureKind::face, 9}, one, corner), "evaluate: the mesh has no face 9");
}

TEST_CASE("evaluate: a distance that is not a number is neither at 0 nor inside") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Placed still(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  Placed lost = still;
  lost.shape.positions[0].setConstant(nan);
  const ContactGeometry found = evaluate(still, {FeatureKind::face, 0}, lost, {FeatureKind::vertex, 0});
  CHECK(std::isnan(found.distance));
  CHECK(std::isnan(found.separation));
  CHECK_FALSE(found.is_interior);
  CHECK_FALSE(evaluate(still, {FeatureKind::face, 0}, lost, {FeatureKind::edge, 0}).is_interior);
  lost.shape.positions[0].setConstant(1e300);
  CHECK_FALSE(evaluate(still, {FeatureKind::face, 0}, lost, {FeatureKind::edge, 0}).is_interior);
}

}  // namespace graze::tests
