// The solver of rigid bodies, under contacts that are written by hand, and which contacts of graze it takes.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "examples/support/shapes.hpp"
#include "rigid/body.hpp"
#include "rigid/graze_contacts.hpp"
#include "rigid/solver.hpp"
#include "support/catch.hpp"

namespace graze::rigid {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Eigen::Vector3d;

constexpr double frame = 1.0 / 60;

std::shared_ptr<const Mesh> mesh_of(const examples::Shape& shape) {
  return std::make_shared<const Mesh>(Mesh::from_triangles(shape.points, shape.triangles));
}

Body box_body(const Vector3d& size, double density = 500) {
  Body body;
  body.set_mass(mass_of(*mesh_of(examples::box(size)), density));
  return body;
}

/// The corners of a box over the plane z = 0, which is body 0.
class BoxOverPlane : public ContactSource {
 public:
  BoxOverPlane(const Vector3d& size, bool has_keys = true) : size_(size), has_keys_(has_keys) {}

  void find(std::span<const Body> bodies, std::vector<Contact>& contacts) override {
    contacts.clear();
    std::uint64_t key = 0;
    for (const Vector3d& corner : examples::box(size_).points) {
      const Vector3d point = bodies[1].to_world(corner);
      ++key;
      if (point.z() < 0.1)
        contacts.push_back(
            {0, 1, {point.x(), point.y(), 0}, point, Vector3d::UnitZ(), point.z(), has_keys_ ? key : 0});
    }
  }

 private:
  Vector3d size_;
  bool has_keys_;
};

struct Nothing : ContactSource {
  void find(std::span<const Body>, std::vector<Contact>& contacts) override { contacts.clear(); }
};

/// Gravity of a slope with an angle, as seen from the slope: it goes down along x.
Vector3d gravity_on(double angle) {
  return 9.81 * Vector3d(std::sin(angle), 0, -std::cos(angle));
}

Vector3d momentum_of(const Body& body) {
  return body.turn * (body.inverse_inertia.inverse() * (body.turn.conjugate() * body.spin));
}

}  // namespace

TEST_CASE("rigid: mass, centre and inertia of a box, where it is and moved") {
  const Vector3d size(1, 2, 3);
  const Vector3d offset(0.5, -1, 2);
  const MassProperties still = mass_of(*mesh_of(examples::box(size)), 10);
  const MassProperties moved = mass_of(*mesh_of(examples::moved(examples::box(size), offset)), 10);
  CHECK_THAT(still.mass, WithinRel(60.0, 1e-12));
  CHECK_THAT(moved.mass, WithinRel(60.0, 1e-12));
  CHECK(still.centre.norm() < 1e-12);
  CHECK((moved.centre - offset).norm() < 1e-12);
  const Eigen::Matrix3d expected = Vector3d(65, 50, 25).asDiagonal();  // m (b² + c²) / 12
  CHECK((still.inertia - expected).norm() < 1e-9);
  CHECK((moved.inertia - expected).norm() < 1e-9);
}

TEST_CASE("rigid: without contacts a body falls, and tumbles with the angular momentum that it had") {
  std::vector<Body> bodies{box_body({1, 2, 3})};
  bodies[0].spin = {0.1, 2, 0.1};  // about the middle axis, so it turns over
  const Vector3d momentum = momentum_of(bodies[0]);
  Solver solver({.substeps = 40});
  Nothing nothing;
  double least = 1;
  for (int i = 0; i < 600; ++i) {
    solver.step(bodies, nothing, frame);
    least = std::min(least, (bodies[0].turn * Vector3d::UnitY()).y());
  }
  CHECK((momentum_of(bodies[0]) - momentum).norm() < 1e-9 * momentum.norm());
  CHECK(least < -0.9);
  CHECK_THAT(bodies[0].velocity.z(), WithinRel(-98.1, 1e-9));
  CHECK_THAT(bodies[0].position.z(), WithinRel(-0.5 * 9.81 * 100, 1e-3));
}

TEST_CASE("rigid: a box falls on a plane, and rests a gap above it") {
  for (const bool has_keys : {true, false}) {
    const Vector3d size(1, 1, 0.5);
    std::vector<Body> bodies{Body(), box_body(size)};
    bodies[1].position.z() = 0.45;
    Solver solver;
    BoxOverPlane plane(size, has_keys);
    double lowest = 1;
    for (int i = 0; i < 120; ++i) {
      solver.step(bodies, plane, frame);
      lowest = std::min(lowest, bodies[1].position.z());
    }
    CHECK(lowest > 0.25);
    CHECK_THAT(bodies[1].position.z(), WithinAbs(0.251, 2e-4));
    CHECK(bodies[1].velocity.norm() < 1e-4);
    CHECK(bodies[1].spin.norm() < 1e-4);
  }
}

TEST_CASE("rigid: a box on a slope stays below the angle of friction, and slides as theory says above it") {
  const Vector3d size(1, 1, 0.2);
  for (const double degrees : {20.0, 26.0, 28.0, 35.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    std::vector<Body> bodies{Body(), box_body(size)};
    bodies[1].position.z() = 0.101;
    Solver solver({.gravity = gravity_on(angle)});
    BoxOverPlane slope(size);
    for (int i = 0; i < 60; ++i) solver.step(bodies, slope, frame);
    const double pull = std::sin(angle) - 0.5 * std::cos(angle);
    INFO(degrees << " degrees");
    CHECK_THAT(bodies[1].velocity.x(), WithinAbs(pull > 0 ? 9.81 * pull : 0, 0.01));
    CHECK(std::abs(bodies[1].velocity.y()) < 1e-6);
  }
}

TEST_CASE("rigid: what is deep comes out no faster than the recovery speed, and does not fly on") {
  const Vector3d size(1, 1, 1);
  std::vector<Body> bodies{Body(), box_body(size)};
  bodies[1].position.z() = 0.3;  // 20 cm deep
  Solver solver({.gravity = Vector3d::Zero(), .recovery_speed = 0.5});
  BoxOverPlane plane(size);
  double fastest = 0;
  for (int i = 0; i < 120; ++i) {
    const double before = bodies[1].position.z();
    solver.step(bodies, plane, frame);
    fastest = std::max(fastest, (bodies[1].position.z() - before) / frame);
  }
  CHECK(fastest < 0.51);
  CHECK(fastest > 0.3);
  CHECK(bodies[1].position.z() > 0.5);
  CHECK(bodies[1].velocity.norm() < 0.1);
}

TEST_CASE("rigid: a body that nothing pushes carries others along") {
  const Vector3d size(1, 1, 0.5);
  std::vector<Body> bodies{Body(), box_body(size)};
  bodies[0].velocity.x() = 0.5;
  bodies[1].position.z() = 0.251;
  Solver solver;
  BoxOverPlane belt(size);
  for (int i = 0; i < 60; ++i) solver.step(bodies, belt, frame);
  CHECK_THAT(bodies[1].velocity.x(), WithinAbs(0.5, 1e-3));
  CHECK_THAT(bodies[0].velocity.x(), WithinAbs(0.5, 1e-12));
}

TEST_CASE("rigid: of a box that is sunk into a floor of cells, contacts of graze point up alone") {
  const Vector3d size(0.4, 0.4, 0.3);
  for (const double height : {-1e-3, 0.0, 1e-3}) {
    std::vector<Body> bodies{Body(), box_body(size)};
    bodies[0].position.z() = -0.1;
    bodies[1].position = {0.013, 0.007, 0.15 + height};
    GrazeContacts source({.contact_distance = 0.04, .threads = 1});
    source.add(mesh_of(examples::box_of_cells({2, 2, 0.2}, 40, 40)), bodies[0]);
    source.add(mesh_of(examples::box(size)), bodies[1]);
    std::vector<Contact> contacts;
    source.find(bodies, contacts);
    REQUIRE(contacts.size() >= 4);
    std::size_t level = 0;
    for (const graze::Contact& contact : source.report()->contacts())
      if (contact.kind != ContactKind::EF && std::abs(contact.push().z()) < 0.5) ++level;
    CHECK(level > 10);
    for (const Contact& contact : contacts) {
      CHECK(contact.push.z() > 0.98);
      CHECK(contact.separation > height - 1e-12);
      CHECK(contact.key != 0);
    }
  }
}

}  // namespace graze::rigid
