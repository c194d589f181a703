// The comparison of rigid bodies: its referee finds what is through, its shapes are what their parts make up,
// and it counts contacts that jump.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <graze/graze.hpp>
#include <vector>

#include "bench/rigid_bodies/bodies_through.hpp"
#include "bench/rigid_bodies/rigid_body_measures.hpp"
#include "bench/rigid_bodies/rigid_body_scenes.hpp"
#include "bench/rigid_bodies/rigid_body_shapes.hpp"
#include "scenes/random.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;

rigid::Body body_at(const Vector3d& position) {
  rigid::Body body;
  body.position = position;
  return body;
}

/// What is inside what of two bodies, where points count as deep from 1 cm on.
bench::Overlaps overlaps_of(const std::array<bench::RigidBodyShapePtr, 2>& shapes,
                            const std::array<rigid::Body, 2>& bodies) {
  return bench::BodiesThrough(shapes, 0.01).find(bodies);
}

/// Whether the surfaces of two bodies pass through each other, by graze.
bool do_cross(const std::array<bench::RigidBodyShapePtr, 2>& shapes,
              const std::array<rigid::Body, 2>& bodies) {
  Scene scene({.detail = ContactDetail::nearest});
  for (std::size_t i = 0; i < 2; ++i) {
    const ObjectId id = scene.add(shapes[i]->mesh, {.motion = Motion::rigid});
    scene.set_pose(id, bodies[i].pose());
  }
  const ReportHandle report = scene.step();
  return std::ranges::any_of(report->contacts(), [](const Contact& contact) {
    return contact.kind == ContactKind::EF && contact.distance == 0;
  });
}

}  // namespace

TEST_CASE("rigid bodies: the referee finds what is through, and how deep") {
  const auto crate = bench::box_shape({0.25, 0.25, 0.25});
  const auto pebble = bench::box_shape({0.05, 0.05, 0.05});
  const auto plank = bench::box_shape({0.6, 0.12, 0.05});
  const auto ring = bench::ring_shape();
  rigid::Body across = body_at({0, 0, 0.07});
  across.turn = Eigen::AngleAxisd(1.5, Vector3d::UnitZ());
  rigid::Body linked = body_at({0.18, 0, 0});
  linked.turn = Eigen::AngleAxisd(1.57, Vector3d::UnitX());
  const rigid::Body origin = body_at({0, 0, 0});
  struct Case {
    const char* what;
    std::array<bench::RigidBodyShapePtr, 2> shapes;
    rigid::Body second;
    bool is_deep, is_crossing;
  };
  const Case cases[] = {
      {"a crate above a crate", {crate, crate}, body_at({0.03, 0.02, 0.501}), false, false},
      {"a crate that sank in by 5 mm", {crate, crate}, body_at({0.03, 0.02, 0.495}), false, true},
      {"a crate that sank in by 3 cm", {crate, crate}, body_at({0.03, 0.02, 0.47}), true, true},
      {"a pebble in a crate", {crate, pebble}, body_at({0.1, 0, 0}), true, false},
      {"the same crate that is in a pebble", {pebble, crate}, body_at({0.1, 0, 0}), true, false},
      {"a plank that sank into a plank, with no vertex inside", {plank, plank}, across, true, true},
      {"two links of a chain", {ring, ring}, linked, false, false}};
  for (const auto& [what, shapes, second, is_deep, is_crossing] : cases) {
    INFO(what);
    const bench::Overlaps overlaps = overlaps_of(shapes, {origin, second});
    CHECK(overlaps.deep.size() == (is_deep ? 1 : 0));
    CHECK(overlaps.crossing.size() == (is_crossing ? 1 : 0));
  }
}

TEST_CASE("rigid bodies: the referee and graze agree on what crosses") {
  const std::array shapes{bench::box_shape({0.2, 0.15, 0.1}), bench::l_shape(), bench::ring_shape(),
                          bench::pawn_shape()};
  scenes::Random random(7);
  int crossing = 0;
  constexpr int trials = 60;
  for (int trial = 0; trial < trials; ++trial) {
    const std::array pair{shapes[random.below(4)], shapes[random.below(4)]};
    std::array bodies{body_at({0, 0, 0}), body_at(random.vector(-0.35, 0.35))};
    for (rigid::Body& body : bodies) body.turn = random.turn();
    const bool does_cross = do_cross(pair, bodies);
    CHECK(overlaps_of(pair, bodies).crossing.empty() != does_cross);
    crossing += does_cross ? 1 : 0;
  }
  CHECK(crossing > trials / 5);
  CHECK(crossing < trials * 4 / 5);
}

TEST_CASE("rigid bodies: parts have the vertices of the surface, about the centre of mass") {
  for (const auto& [shape, parts, every] :
       {std::tuple(bench::box_shape({1, 2, 3}), 1U, 1U), std::tuple(bench::l_shape(), 2U, 1U),
        std::tuple(bench::ring_shape(), 16U, 1U), std::tuple(bench::pawn_shape(), 7U, 2U)}) {
    REQUIRE(shape->plain.parts.size() == parts);
    CHECK(shape->mass.centre.norm() < 1e-12);
    std::size_t in_a_part = 0;
    for (const Vector3d& vertex : shape->mesh->rest()) {
      const auto has_vertex = [&](const std::vector<double>& part) {
        for (std::size_t i = 0; i < part.size(); i += 3)
          if ((vertex - Vector3d(part[i], part[i + 1], part[i + 2])).norm() < 1e-12) return true;
        return false;
      };
      in_a_part += std::ranges::any_of(shape->plain.parts, has_vertex) ? 1U : 0U;
    }
    CHECK(in_a_part >= shape->mesh->vertex_count() / every);
  }
}

TEST_CASE("rigid bodies: contacts that come out of nothing are counted") {
  const std::vector<rigid::Body> bodies{body_at({0, 0, 0}), body_at({0, 0, 1})};
  const auto contact_at = [](double x, double separation) {
    rigid::Contact contact;
    contact.b = 1;
    contact.on_a = contact.on_b = {x, 0, 0.5};
    contact.separation = separation;
    return contact;
  };
  bench::ContactJumps jumps;
  const std::vector first{contact_at(0, 0.001), contact_at(1, 0.01)};
  jumps.see(bodies, first);
  CHECK(jumps.share() == 1);  // before the first step there was nothing
  jumps.restart();
  jumps.see(bodies, first);
  CHECK(jumps.share() == 0);
  // One is new, one was there but too far to carry, one is too far now.
  jumps.restart();
  const std::vector second{contact_at(0.1, 0.001), contact_at(1.001, 0.001), contact_at(2, 0.01)};
  jumps.see(bodies, second);
  CHECK(jumps.share() == 0.5);
  // A body that is carried along carries its contacts.
  jumps.restart();
  std::vector<rigid::Body> moved = bodies;
  std::vector carried = second;
  for (rigid::Body& body : moved) body.position.x() += 1;
  for (rigid::Contact& contact : carried) contact.on_b.x() += 1;
  jumps.see(moved, carried);
  CHECK(jumps.share() == 0);
}

TEST_CASE("rigid bodies: bodies stand where they were put, and fall from there") {
  for (const bench::RigidBodyScene& scene : bench::rigid_body_scenes(true)) {
    INFO(scene.name);
    CHECK(bench::height_error(scene, scene.bodies) < 20);
    CHECK(bench::standing(scene, scene.bodies) == scene.heights.size());
    const bench::Overlaps overlaps = bench::BodiesThrough(scene.shapes, 0).find(scene.bodies);
    CHECK(overlaps.crossing.empty());
    CHECK(overlaps.deep.empty());
    if (scene.heights.empty()) continue;
    std::vector<rigid::Body> fallen = scene.bodies;
    fallen.back().position.z() -= 0.1;
    CHECK(bench::height_error(scene, fallen) > 80);
    CHECK(bench::standing(scene, fallen) == scene.heights.size() - 1);
    CHECK(bench::speed_between(scene, scene.bodies, fallen, 1) > 0);
  }
}

}  // namespace graze::tests
