#include "support/random/random_solids.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "support/exact/exact_shape.hpp"
#include "support/exact/exact_winding.hpp"

namespace graze::oracle {

namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;

/// A step of the grid. It makes halves and quarters of it whole numbers, with which rationals are fastest.
constexpr double grid_step = 4;

/// A point with whole coordinates from 0 to `size`.
Eigen::Vector3d whole_point(Random& random, std::uint32_t size) {
  const double x = random.below(size + 1);
  const double y = random.below(size + 1);
  return {x, y, static_cast<double>(random.below(size + 1))};
}

/// A whole number of at least half of `size`, and at most `size`.
double whole_length(Random& random, std::uint32_t size) {
  const std::uint32_t low = (size + 1) / 2;
  return low + random.below(size - low + 1);
}

Shape random_box(Random& random, std::uint32_t size) {
  Shape shape;
  const double x = whole_length(random, size);
  const double y = whole_length(random, size);
  const Eigen::Vector3d extent(x, y, whole_length(random, size));
  for (unsigned i = 0; i < 8; ++i)
    shape.positions.emplace_back(extent.cwiseProduct(Eigen::Vector3d(i & 1U, (i >> 1U) & 1U, i >> 2U)));
  shape.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return shape;
}

Shape random_tetrahedron(Random& random, std::uint32_t size) {
  Shape shape;
  for (int i = 0; i < 4; ++i) shape.positions.push_back(whole_point(random, size));
  shape.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return shape;
}

Shape random_octahedron(Random& random, std::uint32_t size) {
  Shape shape;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      shape.positions.emplace_back(sign * whole_length(random, size) * Eigen::Vector3d::Unit(axis));
  shape.faces = {{1, 3, 5}, {3, 0, 5}, {0, 2, 5}, {2, 1, 5}, {3, 1, 4}, {0, 3, 4}, {2, 0, 4}, {1, 2, 4}};
  return shape;
}

Shape random_prism(Random& random, std::uint32_t size) {
  const double height = whole_length(random, size);
  const double width = whole_length(random, size);
  const double depth = whole_length(random, size);
  Shape shape;
  for (const double z : {0.0, height}) {
    shape.positions.emplace_back(0, 0, z);
    shape.positions.emplace_back(width, 0, z);
    shape.positions.emplace_back(0, depth, z);
  }
  shape.faces = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  return shape;
}

/// A square frame: a torus with square corners and a hole along z.
Shape random_frame(Random& random, std::uint32_t size) {
  const double hole = whole_length(random, size);
  const double border = whole_length(random, 2);
  const double height = whole_length(random, size);
  Shape shape;
  for (const double half : {hole / 2 + border, hole / 2})
    for (const double z : {0.0, height})
      for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        shape.positions.emplace_back(half * x, half * y, z);
  // The outer corners below and above are 0 to 3 and 4 to 7, the inner ones 8 to 11 and 12 to 15.
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    shape.faces.push_back({i, next, next + 4, i + 4});
    shape.faces.push_back({next + 8, i + 8, i + 12, next + 12});
    shape.faces.push_back({i + 4, next + 4, next + 12, i + 12});
    shape.faces.push_back({next, i, i + 8, next + 8});
  }
  return shape;
}

/// Three by three quads that close in both directions, over vertices anywhere: a torus that crosses itself.
Shape random_torus(Random& random, std::uint32_t size) {
  Shape shape;
  for (int i = 0; i < 9; ++i) shape.positions.push_back(whole_point(random, size));
  for (std::uint32_t i = 0; i < 3; ++i)
    for (std::uint32_t j = 0; j < 3; ++j) {
      const std::uint32_t row = 3 * ((i + 1) % 3);
      const std::uint32_t column = (j + 1) % 3;
      shape.faces.push_back({3 * i + j, row + j, row + column, 3 * i + column});
    }
  return shape;
}

std::uint32_t vertex_count(const Shape& shape) {
  return static_cast<std::uint32_t>(shape.positions.size());
}

/// A closed shape of one part, of up to eight vertices.
Shape random_part(Random& random, std::uint32_t size) {
  const std::uint32_t form = random.below(8);
  if (form == 0) return random_tetrahedron(random, size);
  if (form < 3) return random_octahedron(random, std::max(1U, size * 2 / 3));
  return form < 5 ? random_prism(random, size) : random_box(random, size);
}

void turn_inside_out(Shape& shape) {
  for (auto& face : shape.faces) std::reverse(face.begin(), face.end());
}

void shift(Shape& shape, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& position : shape.positions) position += by;
}

void append(Shape& shape, const Shape& part) {
  const auto first = static_cast<std::uint32_t>(shape.positions.size());
  shape.positions.insert(shape.positions.end(), part.positions.begin(), part.positions.end());
  for (auto face : part.faces) {
    for (std::uint32_t& corner : face) corner += first;
    shape.faces.push_back(std::move(face));
  }
}

/// The mean of all vertices, rounded to whole numbers.
Eigen::Vector3d whole_middle(const Shape& shape) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& position : shape.positions) sum += position;
  return (sum / vertex_count(shape)).array().round();
}

/// Two closed parts: one may lie in the other, as a core or a cavity.
Shape random_parts(Random& random, std::uint32_t size) {
  Shape shape = random_part(random, size);
  Shape part = random_part(random, random.chance(0.6) ? std::max(1U, size / 2) : size);
  if (random.chance(0.4)) turn_inside_out(part);
  if (random.chance(0.5)) shift(part, whole_middle(shape) - whole_middle(part));
  shift(part, whole_point(random, size / 2));
  append(shape, part);
  return shape;
}

/// Splits quads at random.
void split_quads(Shape& shape, Random& random) {
  Faces faces;
  const double chance = random.chance(0.5) ? 0.5 : 0.1;
  for (const auto& face : shape.faces) {
    if (face.size() == 3 || !random.chance(chance)) {
      faces.push_back(face);
    } else if (random.chance(0.5)) {
      faces.push_back({face[0], face[1], face[2]});
      faces.push_back({face[0], face[2], face[3]});
    } else {
      faces.push_back({face[1], face[2], face[3]});
      faces.push_back({face[1], face[3], face[0]});
    }
  }
  shape.faces = std::move(faces);
}

/// A closed shape with whole coordinates.
Shape random_closed(Random& random, std::uint32_t size) {
  const std::uint32_t form = random.below(12);
  Shape shape = form < 6    ? random_part(random, size)
                : form == 6 ? random_frame(random, size)
                : form == 7 ? random_torus(random, size)
                            : random_parts(random, size);
  split_quads(shape, random);
  if (random.chance(0.15))
    for (std::uint32_t i = 0; i < 3; ++i)
      shape.positions[random.below(vertex_count(shape))] = whole_point(random, size);
  if (random.chance(0.25)) turn_inside_out(shape);
  return shape;
}

/// Puts an unused vertex, which nobody may read, in front of all others.
void add_unused_vertex(Shape& shape) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  shape.positions.insert(shape.positions.begin(), Eigen::Vector3d(nothing, nothing, nothing));
  for (auto& face : shape.faces)
    for (std::uint32_t& corner : face) ++corner;
}

/// A point of a shape: one of its vertices, the middle of two vertices of a face, or of the whole.
Eigen::Vector3d some_point(const Shape& shape, Random& random) {
  const auto& face = shape.faces[random.below(static_cast<std::uint32_t>(shape.faces.size()))];
  const Eigen::Vector3d& first = shape.positions[face[random.below(3)]];
  const Eigen::Vector3d& second = shape.positions[face[random.below(3)]];
  if (random.chance(0.5)) return (first + second) / 2;
  return (first + shape.positions[random.below(vertex_count(shape))]) / 2;
}

/// Every vertex moved off the grid a little.
void blur(Shape& shape, Random& random) {
  for (Eigen::Vector3d& position : shape.positions) position += random.vector(-0.2, 0.2);
}

}  // namespace

RandomSolids random_solids(std::uint64_t seed) {
  Random random(seed);
  const bool is_nested = random.chance(0.6);
  Shape large = random_closed(random, is_nested ? 8 : 2 + random.below(4));
  Shape small = random_closed(random, is_nested ? 1 : 1 + random.below(3));
  const Eigen::Vector3d target = is_nested ? whole_middle(large) : some_point(large, random);
  const Eigen::Vector3d onto = some_point(small, random);
  shift(small, target - onto);
  if (random.chance(0.3)) shift(small, whole_point(random, 2) - Eigen::Vector3d(1, 1, 1));
  if (seed % 2 == 0) {
    blur(large, random);
    blur(small, random);
  }

  RandomSolids scene{std::move(large), std::move(small), {}, 0};
  if (random.chance(0.5)) std::swap(scene.a, scene.b);
  scene.solids.a = random.chance(0.7);
  scene.solids.b = random.chance(0.7);
  if (!scene.solids.a && random.chance(0.5)) scene.a.faces.pop_back();
  if (!scene.solids.b && random.chance(0.5)) scene.b.faces.pop_back();
  scene.threshold = grid_step * random.below(4);
  for (Shape* shape : {&scene.a, &scene.b}) {
    for (Eigen::Vector3d& position : shape->positions) position *= grid_step;
    if (random.chance(0.2)) add_unused_vertex(*shape);
  }
  return scene;
}

void move_on_grid(Shape& shape, Random& random) {
  if (random.chance(0.7)) {
    shift(shape, grid_step * (whole_point(random, 2) - Eigen::Vector3d(1, 1, 1)));
  } else {
    shape.positions[random.below(vertex_count(shape))] +=
        grid_step * (whole_point(random, 2) - Eigen::Vector3d(1, 1, 1));
  }
}

bool is_closed(const Shape& shape) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passes;
  for (const auto& face : shape.faces)
    for (std::size_t i = 0; i < face.size(); ++i) ++passes[{face[i], face[(i + 1) % face.size()]}];
  return std::all_of(passes.begin(), passes.end(), [&](const auto& entry) {
    const auto& [from, to] = entry.first;
    const auto back = passes.find({to, from});
    return entry.second == 1 && back != passes.end() && back->second == 1;
  });
}

void SolidCoverage::count(const RandomSolids& scene) {
  const SolidPair pair = solid_pair(scene.a, scene.b, scene.solids, scene.threshold);
  ++containments[static_cast<std::size_t>(pair.inside)];
  const bool is_pierced = std::any_of(pair.contacts.begin(), pair.contacts.end(),
                                      [](const Named& contact) { return contact.pierced; });
  if (pair.inside == Containment::crossing && !is_pierced) ++without_piercing;
  deep_contacts += pair.contacts.size() - nearest(scene.a, scene.b, scene.threshold).size();
  for (const SolidSides& sides : pair.sides) both_sides += sides.a && sides.b ? 1U : 0U;

  const auto count_vertices = [this](const Shape& of, const Shape& solid) {
    const ExactShape exact(of);
    const WindingOracle oracle(solid);
    for (const std::uint32_t vertex : exact.used) {
      const Winding about = oracle.about(of.positions[vertex]);
      on_surface += about.on_surface ? 1U : 0U;
      inside_by_winding_two += about.number >= 2 ? 1U : 0U;
      inside_by_negative += about.number < 0 ? 1U : 0U;
    }
  };
  if (scene.solids.b) count_vertices(scene.a, scene.b);
  if (scene.solids.a) count_vertices(scene.b, scene.a);
}

}  // namespace graze::oracle
