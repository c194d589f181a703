// Mass-spring bodies: which springs a mesh has, and what physics they keep.

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "scenes/random.hpp"
#include "springs/mass_spring_body.hpp"
#include "support/catch.hpp"

namespace graze::springs {
namespace {

using scenes::Random;

Points points_of(const models::MeshData& mesh) {
  Points points(static_cast<Eigen::Index>(mesh.positions.size()), 3);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = mesh.positions[i].transpose();
  return points;
}

MassSpringBody body_of(const models::MeshData& mesh, double step, double stiffness = 1) {
  return {points_of(mesh), springs_of(mesh, {stiffness, stiffness, stiffness}), 0.5, step};
}

Points random_points(Random& random, Eigen::Index count, double size) {
  Points points(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) points.row(row) = random.vector(-size, size).transpose();
  return points;
}

double total_energy(const MassSpringBody& body) {
  return body.kinetic_energy() + body.elastic_energy();
}

std::map<SpringKind, std::size_t> counts_of(const std::vector<Spring>& springs) {
  std::map<SpringKind, std::size_t> counts;
  for (const Spring& spring : springs) ++counts[spring.kind];
  return counts;
}

}  // namespace

TEST_CASE("springs of a sheet of quads: edges, diagonals, and every second vertex along rows and columns") {
  const std::size_t columns = 5;
  const std::size_t rows = 3;
  const auto sheet = models::sheet(columns, rows, 2, 1);
  const std::vector<Spring> springs = springs_of(sheet, {3, 2, 1});
  auto counts = counts_of(springs);
  CHECK(counts[SpringKind::structural] == columns * (rows + 1) + rows * (columns + 1));
  CHECK(counts[SpringKind::shear] == 2 * columns * rows);
  CHECK(counts[SpringKind::bend] == (columns - 1) * (rows + 1) + (rows - 1) * (columns + 1));
  std::set<std::array<std::uint32_t, 2>> pairs;
  for (const Spring& spring : springs) {
    CHECK(spring.a < spring.b);
    CHECK(pairs.insert({spring.a, spring.b}).second);
    CHECK(spring.rest_length == (sheet.positions[spring.a] - sheet.positions[spring.b]).norm());
    CHECK(spring.stiffness == 3 - static_cast<int>(spring.kind));
    // Across one cell, or straight across two.
    const std::uint32_t across = spring.b - spring.a;
    const std::uint32_t row = columns + 1;
    if (spring.kind == SpringKind::structural) CHECK((across == 1 || across == row));
    if (spring.kind == SpringKind::shear) CHECK((across == row - 1 || across == row + 1));
    if (spring.kind == SpringKind::bend) CHECK((across == 2 || across == 2 * row));
  }
}

TEST_CASE("springs of triangles: a bend between the opposite corners of each edge") {
  const auto mesh = models::sphere(7, 4);
  std::set<std::array<std::uint32_t, 2>> edges;
  std::set<std::array<std::uint32_t, 2>> opposite;
  const std::size_t faces = mesh.corner_counts.size();
  const auto corner = [&](std::size_t face, std::size_t i) { return mesh.corners[3 * face + i % 3]; };
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      edges.insert({std::min(corner(f, i), corner(f, i + 1)), std::max(corner(f, i), corner(f, i + 1))});
      for (std::size_t g = 0; g < faces; ++g)
        for (std::size_t j = 0; j < 3; ++j)
          if (corner(f, i) == corner(g, j + 1) && corner(f, i + 1) == corner(g, j))
            opposite.insert(
                {std::min(corner(f, i + 2), corner(g, j + 2)), std::max(corner(f, i + 2), corner(g, j + 2))});
    }
  std::size_t bends = 0;
  for (const auto& pair : opposite) bends += edges.contains(pair) ? 0U : 1U;
  auto counts = counts_of(springs_of(mesh, {}));
  CHECK(counts[SpringKind::structural] == edges.size());
  CHECK(counts[SpringKind::shear] == 0);
  CHECK(counts[SpringKind::bend] == bends);
}

TEST_CASE("momentum is kept, and the middle moves in a straight line") {
  Random random(5);
  for (const double step : {0.05, 1.0, 20.0}) {
    MassSpringBody body = body_of(models::torus(16, 8, 1, 0.4), step);
    body.set_velocities(random_points(random, body.positions().rows(), 0.3));
    const Eigen::RowVector3d momentum = body.momentum();
    const Eigen::RowVector3d middle = body.positions().colwise().mean();
    const double mass = 0.5 * static_cast<double>(body.positions().rows());
    for (int i = 1; i <= 50; ++i) {
      body.step();
      REQUIRE((body.momentum() - momentum).norm() < 1e-7 * (1 + momentum.norm()));
      const Eigen::RowVector3d expected = middle + (i * step / mass) * momentum;
      REQUIRE((body.positions().colwise().mean() - expected).norm() < 1e-7 * (1 + expected.norm()));
    }
  }
}

TEST_CASE("outer forces change momentum by their sum") {
  Random random(6);
  MassSpringBody body = body_of(models::cylinder(), 0.7);
  const Points forces = random_points(random, body.positions().rows(), 0.1);
  body.step(forces);
  CHECK((body.momentum() - 0.7 * forces.colwise().sum()).norm() < 1e-10);
}

TEST_CASE("energy is never won, at small steps and at steps of many periods") {
  Random random(7);
  for (const double step : {0.02, 0.5, 5.0, 500.0}) {
    MassSpringBody body = body_of(models::sheet(8, 8, 2, 2), step, 4);
    body.set_velocities(random_points(random, body.positions().rows(), 1 / step));
    double energy = total_energy(body);
    const double start = energy;
    for (int i = 0; i < 100; ++i) {
      body.step();
      INFO("step of " << step << ", number " << i);
      REQUIRE(body.elastic_energy() <= energy * (1 + 1e-9));
      REQUIRE(total_energy(body) <= (step < 1 ? energy : start) * (1 + 1e-9));
      energy = total_energy(body);
    }
    CHECK(energy < 0.9 * start);
  }
}

TEST_CASE("a body at rest stays at rest") {
  MassSpringBody body = body_of(models::pawn(), 3);
  const Points rest = body.positions();
  for (int i = 0; i < 20; ++i) body.step();
  CHECK((body.positions() - rest).cwiseAbs().maxCoeff() < 1e-10);
  CHECK(total_energy(body) < 1e-18);
}

TEST_CASE("a body turned stiffly stays as it is, since springs know no direction") {
  MassSpringBody body = body_of(models::cylinder(), 1);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Points turned = body.positions() * turn.transpose();
  body.set_positions(turned);
  for (int i = 0; i < 20; ++i) body.step();
  CHECK((body.positions() - turned).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("two masses on a spring swing in the period that theory gives") {
  Points ends(2, 3);
  ends << 0, 0, 0, 1, 0, 0;
  const double stiffness = 2;
  const double mass = 0.5;
  const double step = 1e-3;
  MassSpringBody body(ends, {{0, 1, SpringKind::structural, 1, stiffness}}, mass, step);
  Points velocities = Points::Zero(2, 3);
  velocities(0, 0) = -0.05;
  velocities(1, 0) = 0.05;
  body.set_velocities(velocities);
  const auto stretch = [&] { return (body.positions().row(1) - body.positions().row(0)).norm() - 1; };
  int steps = 1;
  body.step();
  while (stretch() > 0 && steps < 100000) {
    body.step();
    ++steps;
  }
  const double half_period = std::numbers::pi * std::sqrt(mass / 2 / stiffness);
  CHECK(steps * step == Approx(half_period).epsilon(0.005));
}

TEST_CASE("bodies without mass or time are refused") {
  const Points points = Points::Zero(2, 3);
  CHECK_THROWS_AS(MassSpringBody(points, {}, 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(MassSpringBody(points, {}, 1, 0), std::invalid_argument);
}

}  // namespace graze::springs
