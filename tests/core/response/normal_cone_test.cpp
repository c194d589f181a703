// This test compares in_normal_cone() with angles that are measured one by one, and asks which contacts of a
// box on a floor of cells bear.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <graze/contact_geometry.hpp>
#include <limits>

#include "core/placed_shape.hpp"
#include "core/shapes.hpp"
#include "models/models.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

const double tolerance = std::asin(std::sqrt(1.0 / 32));  // 10.2°
const double quarter_turn = std::acos(0.0);

bool in_cone(const Placed& of, const Feature& feature, const Vector3d& direction) {
  return in_normal_cone(*of.mesh, of.shape.positions, feature, direction);
}

double angle_of(const Vector3d& first, const Vector3d& second) {
  return std::atan2(first.cross(second).norm(), first.dot(second));
}

Vector3d normal_of(const Shape& shape, std::size_t face) {
  const auto& corners = shape.faces[face];
  const Vector3d& first = shape.positions[corners[0]];
  return (shape.positions[corners[1]] - first).cross(shape.positions[corners[2]] - first);
}

bool has(const std::vector<std::uint32_t>& face, std::uint32_t vertex) {
  return std::find(face.begin(), face.end(), vertex) != face.end();
}

/// How far a direction leans over the surface about a feature of a mesh of triangles, in radians. It is
/// negative where the surface falls away all around.
double lean_of(const Placed& of, const Feature& feature, const Vector3d& direction) {
  const Shape& shape = of.shape;
  if (feature.kind == FeatureKind::face) {
    const double angle = angle_of(normal_of(shape, feature.index), direction);
    return std::min(angle, 2 * quarter_turn - angle);
  }
  double lean = -quarter_turn;
  const auto add = [&](const Vector3d& way) {
    lean = std::max(lean, quarter_turn - angle_of(way, direction));
  };
  if (feature.kind == FeatureKind::vertex) {
    for (const auto& face : shape.faces)
      for (const std::uint32_t corner : face)
        if (corner != feature.index && has(face, feature.index))
          add(shape.positions[corner] - shape.positions[feature.index]);
    return lean;
  }
  const auto [start, end] = of.mesh->edge(feature.index);
  const Eigen::ParametrizedLine<double, 3> line =
      Eigen::ParametrizedLine<double, 3>::Through(shape.positions[start], shape.positions[end]);
  for (const auto& face : shape.faces)
    if (has(face, start) && has(face, end))
      for (const std::uint32_t corner : face)
        if (corner != start && corner != end)
          add(shape.positions[corner] - line.projection(shape.positions[corner]));
  return lean;
}

/// A box that stands over a floor of cells at a height, and may be moved along it.
Shape box_over(double height, double x) {
  return mapped(shape_of(models::box({0.5, 0.5, 0.5}, models::Faces::triangles)), 1,
                {x, 0.017, height + 0.25});
}

}  // namespace

TEST_CASE("normal cone: directions of random surfaces are in it where their angles are within 10.2 degrees") {
  Random random(5);
  std::size_t inside = 0;
  std::size_t outside = 0;
  for (int scene = 0; scene < 40; ++scene) {
    const std::uint32_t around = 8 + random.below(12);
    Shape shape = shape_of(models::sphere(around, 4 + random.below(6)));
    for (Vector3d& position : shape.positions) position *= 1 + random.between(-0.1, 0.1);
    const Placed placed(shape);
    const std::array counts{placed.mesh->vertex_count(), placed.mesh->edge_count(),
                            placed.mesh->face_count()};
    for (std::size_t kind = 0; kind < counts.size(); ++kind)
      for (int i = 0; i < 100; ++i) {
        const Feature feature{static_cast<FeatureKind>(kind), random.below(counts[kind])};
        Vector3d direction{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
        if (feature.kind == FeatureKind::face)
          direction = normal_of(shape, feature.index).normalized() + 0.3 * direction;
        if (feature.kind == FeatureKind::edge) {
          const auto [start, end] = placed.mesh->edge(feature.index);
          direction = direction.cross(shape.positions[end] - shape.positions[start]);
        }
        direction *= std::exp(random.between(-20, 20));
        const double lean = lean_of(placed, feature, direction);
        if (std::abs(lean - tolerance) < 1e-9) continue;
        INFO("scene " << scene << ", " << kind << " " << feature.index << ": " << lean);
        REQUIRE(in_cone(placed, feature, direction) == (lean < tolerance));
        ++(lean < tolerance ? inside : outside);
      }
  }
  CHECK(inside > 1000);
  CHECK(outside > 1000);
}

TEST_CASE("normal cone: of a box on a floor of cells, what bears points up") {
  const Placed floor(shape_of(models::sheet(20, 20, 1, 1)));
  for (const double height : {0.0, 1e-6, 1e-3, -1e-3})
    for (const double x : {0.0, 0.013, 0.031}) {
      const Placed box(box_over(height, x));
      std::size_t flat = 0;
      std::size_t bearing = 0;
      for (const Contact& contact : contacts_of(floor, box, ContactDetail::nearest, 0.04).contacts) {
        if (contact.kind == ContactKind::EF && contact.distance == 0) continue;
        const auto bears = [&](const Placed& of, const Feature& feature, const Vector3d& direction) {
          return feature.kind == FeatureKind::face || in_cone(of, feature, direction);
        };
        const bool does =
            bears(floor, contact.feature_a, contact.push()) && bears(box, contact.feature_b, -contact.push());
        INFO("height " << height << ", x " << x << ", push " << contact.push().transpose());
        CHECK((!does || contact.push().z() > std::cos(tolerance) - 1e-9));
        if (does) ++bearing;
        if (std::abs(contact.push().z()) < 0.5) ++flat;
      }
      CHECK(bearing >= 4);
      CHECK(flat > 10);
    }
}

TEST_CASE("normal cone: features that a mesh has not, and positions of another mesh, are refused") {
  const Placed one(shape_of(models::sheet(1, 1, 1, 1)));
  for (const Feature& wrong : {Feature{FeatureKind::vertex, 4}, Feature{FeatureKind::edge, 4},
                               Feature{FeatureKind::face, 1}, Feature{static_cast<FeatureKind>(7), 0}})
    CHECK_THROWS_AS(in_cone(one, wrong, Vector3d::UnitZ()), Error);
  const std::vector<Vector3d> two{{0, 0, 0}, {1, 0, 0}};
  CHECK_THROWS_WITH(in_normal_cone(*one.mesh, two, {FeatureKind::vertex, 0}, Vector3d::UnitZ()),
                    "in_normal_cone: 2 positions for a mesh of 4 vertices");
}

TEST_CASE("normal cone: a quad that is not flat has the directions of both of its triangles") {
  const Placed quad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2, 3}}});
  for (const Vector3d& along : {Vector3d(0, -1, 1), Vector3d(-1, 0, 1)}) {
    CHECK(in_cone(quad, {FeatureKind::face, 0}, along));
    CHECK(in_cone(quad, {FeatureKind::face, 0}, -along));
  }
  CHECK_FALSE(in_cone(quad, {FeatureKind::face, 0}, Vector3d::UnitZ()));
}

}  // namespace graze::tests
