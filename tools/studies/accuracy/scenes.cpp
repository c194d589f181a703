#include "accuracy/scenes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "accuracy/lattice.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tools {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;
using Shapes = std::array<Shape, 2>;

Vector3d point(Random& random, double size) {
  const double x = random.between(-size, size);
  const double y = random.between(-size, size);
  return {x, y, random.between(-size, size)};
}

Vector3d direction(Random& random) {
  return point(random, 1).normalized();
}

double power_of_ten(Random& random, double from, double to) {
  return std::pow(10.0, random.between(from, to));
}

void move(Shape& shape, const Vector3d& by) {
  for (Vector3d& corner : shape.positions) corner += by;
}

Shape triangle(Random& random) {
  Shape shape{{point(random, 0.5), point(random, 0.5), point(random, 0.5)}, {{0, 1, 2}}};
  return shape;
}

/// Around a square whose corners are moved about.
Shape warped_quad(Random& random) {
  const Vector3d u = direction(random);
  const Vector3d v = u.unitOrthogonal();
  Shape shape;
  for (int i = 0; i < 4; ++i)
    shape.positions.push_back((i == 0 || i == 3 ? -0.5 : 0.5) * u + (i < 2 ? -0.5 : 0.5) * v +
                              point(random, 0.3));
  shape.faces = {{0, 1, 2, 3}};
  return shape;
}

Shape face(Random& random) {
  const std::uint32_t form = random.below(4);
  if (form == 0) return warped_quad(random);
  if (form == 1) return Lattice(random, 64, 64).flat_face(true, 0);
  return triangle(random);
}

Shapes two_faces(Random& random) {
  Shapes shapes = {face(random), face(random)};
  const double distance = random.between(0, 1.5);
  move(shapes[1], distance * direction(random));
  return shapes;
}

Shapes random_shapes(Random& random) {
  const std::uint32_t form = random.below(8);
  if (form < 4) return two_faces(random);
  if (form < 7) return parallel_shapes(random, false, true);
  const oracle::RandomScene scene = oracle::random_scene(2 * (random.next() >> 2U));
  return {scene.a, scene.b};
}

/// Flattened along one direction.
void squash(Shape& shape, Random& random) {
  const Vector3d along = direction(random);
  const double factor = power_of_ten(random, -9, -3);
  const Vector3d middle = shape.positions[0];
  for (Vector3d& corner : shape.positions) corner -= (1 - factor) * along.dot(corner - middle) * along;
}

double nudged(double value, Random& random) {
  for (std::uint32_t i = random.below(3); i > 0; --i)
    value = std::nextafter(value, random.chance(0.5) ? 4.0 : -4.0);
  return value;
}

void nudge(Shape& shape, Random& random) {
  for (Vector3d& corner : shape.positions)
    for (int axis = 0; axis < 3; ++axis) corner[axis] = nudged(corner[axis], random);
}

Shapes far_away(Random& random) {
  Shapes shapes = random.chance(0.5) ? two_faces(random) : parallel_shapes(random, false, true);
  Vector3d offset;
  for (int axis = 0; axis < 3; ++axis) {
    const int exponent = static_cast<int>(20 + random.below(21));
    offset[axis] = std::ldexp(random.chance(0.5) ? 1 : -1, exponent);
  }
  move(shapes[0], offset);
  move(shapes[1], offset);
  return shapes;
}

Shapes needles(Random& random) {
  Shapes shapes = {face(random), face(random)};
  squash(shapes[0], random);
  if (random.chance(0.7)) squash(shapes[1], random);
  const double distance = power_of_ten(random, -9, 0);
  move(shapes[1], distance * direction(random));
  return shapes;
}

Shapes almost_parallel(Random& random) {
  const Shape a = face(random);
  Shape b = a;
  const double angle = power_of_ten(random, -15, -3);
  const Eigen::AngleAxisd turn(angle, direction(random));
  const double distance = power_of_ten(random, -9, 0);
  const Vector3d shift = distance * direction(random);
  for (Vector3d& corner : b.positions) corner = turn * corner + shift;
  return {a, b};
}

Shapes few_ulps_off(Random& random) {
  const Shape a = face(random);
  Shape b = a;
  nudge(b, random);
  return {a, b};
}

/// A corner of one almost over a border or a corner of the other, where the name of the contact changes.
Shapes almost_over_border(Random& random) {
  const Shape a = random.chance(0.5) ? triangle(random) : warped_quad(random);
  Shape b = triangle(random);
  const Vector3d u = a.positions[1] - a.positions[0];
  const Vector3d across = u.cross(a.positions[2] - a.positions[0]).normalized();
  const Vector3d border = a.positions[0] + (random.chance(0.5) ? random.between(0, 1) : 0.0) * u;
  const Vector3d inwards = random.between(0, 0.3) * across;
  const double distance = power_of_ten(random, -17, -5);
  const Vector3d corner = border + inwards + distance * direction(random);
  b.positions[1] += across;
  b.positions[2] += across;
  move(b, corner - b.positions[0]);
  return {a, b};
}

Shapes small_beside_large(Random& random) {
  Shapes shapes = {face(random), face(random)};
  const double factor = power_of_ten(random, -7, -2);
  const Vector3d place = (shapes[0].positions[0] + shapes[0].positions[1] + shapes[0].positions[2]) / 3;
  for (Vector3d& corner : shapes[1].positions) corner *= factor;
  move(shapes[1], place + factor * point(random, 1));
  if (random.chance(0.5)) std::swap(shapes[0], shapes[1]);
  return shapes;
}

Shapes almost_tied(Random& random) {
  Shapes shapes = parallel_shapes(random, false, true);
  nudge(shapes[1], random);
  return shapes;
}

Shapes nearly_degenerate_shapes(Random& random, std::uint64_t turn) {
  switch (turn % 8) {
    case 0:
      return far_away(random);
    case 1:
      return needles(random);
    case 2:
      return almost_parallel(random);
    case 3:
      return few_ulps_off(random);
    case 4:
      return almost_over_border(random);
    case 5:
      return small_beside_large(random);
    case 6:
      return parallel_shapes(random, true, true);
    default:
      return almost_tied(random);
  }
}

/// Corners at multiples of 1/4, where ties of every kind are common.
Shape grid_face(Random& random) {
  Shape shape;
  const std::uint32_t corners = 3 + random.below(2);
  shape.faces.emplace_back();
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double x = random.below(4);
    const double y = random.below(4);
    shape.positions.push_back(0.25 * Vector3d(x, y, random.below(3)));
    shape.faces[0].push_back(i);
  }
  return shape;
}

Shapes degenerate_shapes(Random& random, std::uint64_t turn) {
  switch (turn % 5) {
    case 0:
      return {grid_face(random), grid_face(random)};
    case 1: {
      Shapes shapes = {collapsed_face(random), random.chance(0.3) ? collapsed_face(random) : face(random)};
      if (random.chance(0.5)) std::swap(shapes[0], shapes[1]);
      return shapes;
    }
    case 2:
      return touching_shapes(random);
    case 3:
      return parallel_shapes(random, false, false);
    default: {
      const oracle::RandomScene scene = oracle::random_scene(2 * (random.next() >> 2U) + 1);
      return {scene.a, scene.b};
    }
  }
}

/// The distance of one of the contacts, or the double before or after it.
double tied_threshold(const KernelScene& scene, Random& random) {
  const auto contacts = oracle::features(scene.a, scene.b, scene.threshold);
  if (contacts.empty()) return scene.threshold;
  const double distance = contacts[random.below(static_cast<std::uint32_t>(contacts.size()))].distance;
  const std::uint32_t side = random.below(3);
  if (side == 0 || distance == 0) return distance;
  return std::nextafter(distance, side == 1 ? 0 : std::numeric_limits<double>::infinity());
}

}  // namespace

KernelScene kernel_scene(InputKind input, std::uint64_t seed, std::uint64_t index) {
  Random random(seed * 0x9e3779b97f4a7c15U + 3 * index + static_cast<std::uint64_t>(input));
  Random scrambled(random.next());
  Shapes shapes = input == InputKind::random              ? random_shapes(scrambled)
                  : input == InputKind::nearly_degenerate ? nearly_degenerate_shapes(scrambled, index)
                                                          : degenerate_shapes(scrambled, index);
  KernelScene scene{std::move(shapes[0]), std::move(shapes[1]), scrambled.between(0.2, 2)};
  if (scrambled.below(4) == 0) scene.threshold = tied_threshold(scene, scrambled);
  return scene;
}

}  // namespace graze::tools
