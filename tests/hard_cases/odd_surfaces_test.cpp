// Open, non-manifold, inconsistently wound, torn, mirrored and inverted surfaces, and thin and pinched ones.

#include <algorithm>
#include <iostream>
#include <map>
#include <tuple>

#include "hard_cases/scene_comparison.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

Shape with_random_winding(Shape shape, std::uint64_t seed) {
  Random random(seed);
  for (auto& face : shape.faces)
    if (random.chance(0.5)) std::reverse(face.begin() + 1, face.end());
  return shape;
}

Shape wound_the_other_way(Shape shape) {
  for (auto& face : shape.faces) std::reverse(face.begin() + 1, face.end());
  return shape;
}

/// Every face with vertices of its own.
Shape unwelded(const Shape& shape) {
  Shape result;
  for (const auto& face : shape.faces) {
    result.faces.emplace_back();
    for (const std::uint32_t corner : face) {
      result.faces.back().push_back(static_cast<std::uint32_t>(result.positions.size()));
      result.positions.push_back(shape.positions[corner]);
    }
  }
  return result;
}

/// Two strips of different widths of cell along a common line, whose vertices do not meet.
Shape t_junctions() {
  Shape shape = shape_of(models::sheet(4, 1, 2, 1));
  const Shape fine = mapped(shape_of(models::sheet(6, 1, 2, 1)), 1, {0, 1, 0});
  const auto first = static_cast<std::uint32_t>(shape.positions.size());
  shape.positions.insert(shape.positions.end(), fine.positions.begin(), fine.positions.end());
  for (auto face : fine.faces) {
    for (std::uint32_t& corner : face) corner += first;
    shape.faces.push_back(face);
  }
  return shape;
}

/// Three sheets that share one edge.
Shape book() {
  Shape shape;
  shape.positions = {{0, -1, 0},    {0, 1, 0},    {1, -1, 0.5}, {1, 1, 0.5},
                     {-1, -1, 0.5}, {-1, 1, 0.5}, {0, -1, -1},  {0, 1, -1}};
  shape.faces = {{0, 2, 3, 1}, {0, 1, 5, 4}, {0, 6, 7, 1}};
  return shape;
}

/// The vertices of one side pushed through to the other.
Shape locally_inverted(Shape shape) {
  for (Vector3d& position : shape.positions)
    if (position.x() > 0.5) position.x() = 0.5 - 2 * (position.x() - 0.5);
  return shape;
}

Shape mirrored(Shape shape) {
  for (Vector3d& position : shape.positions) position.z() *= -1;
  return shape;
}

using VertexFace = std::tuple<Feature, Feature>;

/// The sides on which b's vertices lie of a's faces.
std::map<VertexFace, Side> sides_of(const Shape& a, const Shape& b, double threshold) {
  BodyScene scene({a, b}, settings_of(threshold, infinity));
  const ReportHandle report = scene.step({a, b});
  std::map<VertexFace, Side> sides;
  for (const Contact& contact : report->contacts())
    if (contact.feature_a.kind == FeatureKind::face && contact.feature_b.kind == FeatureKind::vertex)
      sides[{contact.feature_a, contact.feature_b}] = contact.side_a;
  return sides;
}

}  // namespace

TEST_CASE(
    "open, non-manifold, inconsistently wound meshes, unwelded seams, T-junctions, mirrored, inverted") {
  const Shape ball = shape_of(models::sphere(10, 7));
  const Shape quads = shape_of(models::sphere(9, 5, models::Faces::quads));
  const Shape sheet = shape_of(models::sheet(5, 4, 2, 2));
  Tally tally;
  const Body near = mapped(turned(quads, 5), 0.75, {1.7, 0.2, 0.1});
  tally.compare({sheet, mapped(ball, 0.5, {0.25, 0, 0.5})}, 0.05);
  tally.compare({book(), mapped(ball, 0.25, {0, 0, 0.375})}, 0.1);
  tally.compare({book(), mapped(book(), 1, {0.25, 0, 0.25})}, 0.1);
  tally.compare({with_random_winding(ball, 1), near}, 0.1);
  tally.compare({with_random_winding(quads, 2), mapped(with_random_winding(ball, 3), 1, {1.9, 0, 0})}, 0.1);
  tally.compare({unwelded(ball), near}, 0.1);
  tally.compare({unwelded(quads), mapped(unwelded(ball), 0.5, {0.25, 0, 0})}, 0.3);
  tally.compare({t_junctions(), mapped(ball, 0.5, {0, 0.5, 0.5})}, 0.05);
  tally.compare({t_junctions(), mapped(t_junctions(), 1, {0.125, 0.25, 0})}, 0.05);
  tally.compare({{ball, mirrored(ball)}, near}, 0.1);
  tally.compare({{ball, locally_inverted(ball)}, near}, 0.75);
  tally.compare({{quads, locally_inverted(quads)}, {ball, locally_inverted(ball)}}, 0.05);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {  // soups: nothing is manifold
    INFO("soup " << seed);
    const Shape soup = random_soup(seed, 24, 14);
    tally.compare({soup, mapped(random_soup(seed + 2, 20, 12), 1, {0.5, 0.25, 0})}, 0.25);
  }
  CHECK(tally.contacts > 5000);
  tally.print("odd surfaces");
}

TEST_CASE("open and inconsistently wound meshes: sides turn with the winding") {
  std::size_t compared = 0;
  const Shape ball = shape_of(models::sphere(10, 7));
  const Shape spikes = mapped(turned(ball, 2), 1, {1.5, 0.25, 0.125});
  for (const Shape& shape : {ball, shape_of(models::sphere(9, 5, models::Faces::quads)),
                             wobbled(shape_of(models::sheet(6, 5, 2, 2)), 0.1, 1), random_soup(4, 30, 20)}) {
    const auto sides = sides_of(shape, spikes, 0.4);
    const auto reversed = sides_of(wound_the_other_way(shape), spikes, 0.4);
    for (const auto& [contact, side] : sides) {
      // The other winding splits a quad along the same diagonal, from the same first corner.
      REQUIRE(reversed.contains(contact));
      const Side now = reversed.at(contact);
      CHECK(
          (side == Side::none ? now == Side::none : now == (side == Side::front ? Side::back : Side::front)));
      ++compared;
    }
    CHECK(sides.size() == reversed.size());
  }
  CHECK(compared > 50);
  std::cout << "compared " << compared << " sides\n";
}

TEST_CASE("a plate thinner than the threshold") {
  const Shape plate = box({-1, -1, 0}, {2, 2, 0.01});
  const Shape ball = mapped(shape_of(models::sphere(10, 7)), 0.5, {0.1, 0.2, 0.53});
  Tally tally;
  tally.compare({plate, ball}, 0.1);
  tally.compare({plate, mapped(ball, 1, {0, 0, -0.5})}, 0.1);  // through it
  tally.compare({plate, box({-0.5, -0.5, 0.01}, {1, 1, 1})}, 0.1);
  tally.compare({plate, mapped(plate, 1, {0.5, 0.25, 0.02})}, 0.1);
  tally.compare({plate, mapped(plate, 1, {0, 0, 0.005})}, 0.1);
  CHECK(tally.contacts > 100);
  tally.print("thin plates");
}

TEST_CASE("a cloth pinched between two bodies; a garment that copies the body under it") {
  const Shape cloth = shape_of(models::sheet(8, 8, 2, 2));
  const Shape ball = shape_of(models::sphere(10, 7));
  const Shape quads = shape_of(models::sphere(10, 7, models::Faces::quads));
  Tally tally;
  tally.compare({cloth, mapped(ball, 0.5, {0, 0, 0.5}), mapped(ball, 0.5, {0, 0, -0.5})}, 0.05);
  tally.compare({cloth, mapped(ball, 0.5, {0, 0, 0.45}), mapped(quads, 0.5, {0, 0, -0.45})}, 0.05);
  tally.compare({cloth, box({-0.5, -0.5, 0}, {1, 1, 1}), box({-0.5, -0.5, -1}, {1, 1, 1})}, 0.05);
  tally.compare({ball, quads}, 0.05);  // the same vertices, other faces
  tally.compare({{ball, wobbled(ball, 0.2, 3)}, {quads, wobbled(quads, 0.2, 3)}}, 0.02);
  CHECK(tally.contacts > 500);
  tally.print("pinched cloth and garments");
}

}  // namespace graze::tests
