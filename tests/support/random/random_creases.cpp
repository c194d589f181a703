#include "support/random/random_creases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace graze::oracle {

namespace {

using Eigen::Vector3d;

/// The faces of a grid of cells over vertices in rows of `columns` + 1, as quads or split either way.
void add_cells(Shape& shape, std::uint32_t first, std::uint32_t rows, std::uint32_t columns, double quads,
               Random& random) {
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t p = first + row * (columns + 1) + column;
      const std::uint32_t q = p + columns + 1;
      if (random.chance(quads)) {
        shape.faces.push_back({p, p + 1, q + 1, q});
      } else if (random.chance(0.5)) {
        shape.faces.push_back({p, p + 1, q + 1});
        shape.faces.push_back({p, q + 1, q});
      } else {
        shape.faces.push_back({p, p + 1, q});
        shape.faces.push_back({p + 1, q + 1, q});
      }
    }
}

/// Vertices at one place made one, and faces that lose a side by that left out.
Shape welded(const Shape& shape) {
  Shape result;
  std::map<std::array<double, 3>, std::uint32_t> known;
  std::vector<std::uint32_t> number;
  for (const Vector3d& p : shape.positions) {
    const auto [found, is_new] =
        known.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(result.positions.size()));
    if (is_new) result.positions.push_back(p);
    number.push_back(found->second);
  }
  for (auto face : shape.faces) {
    for (std::uint32_t& corner : face) corner = number[corner];
    result.faces.push_back(std::move(face));
  }
  return result;
}

/// A closed box about the origin, each side of `cells` by `cells`.
Shape box_of(const Vector3d& half, std::uint32_t cells, double quads, Random& random) {
  Shape shape;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(shape.positions.size());
      for (std::uint32_t row = 0; row <= cells; ++row)
        for (std::uint32_t column = 0; column <= cells; ++column) {
          const double u = 2.0 * row / cells - 1;
          const double v = 2.0 * column / cells - 1;
          Vector3d point;
          point[axis] = sign;
          point[(axis + 1) % 3] = sign > 0 ? v : u;
          point[(axis + 2) % 3] = sign > 0 ? u : v;
          shape.positions.push_back(half.cwiseProduct(point));
        }
      add_cells(shape, first, cells, cells, quads, random);
    }
  return welded(shape);
}

Vector3d random_half(Random& random) {
  const double x = random.between(0.15, 0.6);
  const double y = random.between(0.15, 0.6);
  return {x, y, random.between(0.15, 0.6)};
}

Shape random_crate(Random& random) {
  Vector3d half = random_half(random);
  if (random.chance(0.3)) half = (4 * half).array().ceil() / 4;  // many numbers are the same then
  const double quads = random.chance(0.4) ? 1 : random.below(2) * 0.5;
  return box_of(half, 1 + random.below(2), quads, random);
}

/// A ball of `rings` circles of `segments` vertices and two poles.
Shape ball_of(std::uint32_t segments, std::uint32_t rings) {
  Shape shape;
  shape.positions.emplace_back(0, 0, -0.5);
  for (std::uint32_t ring = 1; ring <= rings; ++ring) {
    const double latitude = std::numbers::pi * (static_cast<double>(ring) / (rings + 1) - 0.5);
    for (std::uint32_t i = 0; i < segments; ++i) {
      const double longitude = 2 * std::numbers::pi * i / segments;
      shape.positions.emplace_back(0.5 * Vector3d(std::cos(latitude) * std::cos(longitude),
                                                  std::cos(latitude) * std::sin(longitude),
                                                  std::sin(latitude)));
    }
  }
  shape.positions.emplace_back(0, 0, 0.5);
  const std::uint32_t top = rings * segments + 1;
  for (std::uint32_t i = 0; i < segments; ++i) {
    const std::uint32_t next = (i + 1) % segments;
    shape.faces.push_back({0, next + 1, i + 1});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      const std::uint32_t low = 1 + ring * segments;
      shape.faces.push_back({low + i, low + next, low + segments + next});
      shape.faces.push_back({low + i, low + segments + next, low + segments + i});
    }
    shape.faces.push_back({top - segments + i, top - segments + next, top});
  }
  return shape;
}

Shape random_ball(Random& random) {
  const std::uint32_t segments = 4 + random.below(6);
  return ball_of(segments, 2 + random.below(3));
}

/// A star-shaped solid: a ball of which each vertex is nearer to the middle or further away.
Shape random_hull(Random& random) {
  Shape shape = random_ball(random);
  const double spikes = random.between(0.1, 0.6);
  for (Vector3d& position : shape.positions) position *= 1 + random.between(-spikes, spikes);
  return shape;
}

/// A sheet about the origin whose heights are those of `height(x, y)`.
template <typename Height>
Shape sheet_of(std::uint32_t cells, double quads, Random& random, const Height& height) {
  Shape shape;
  for (std::uint32_t row = 0; row <= cells; ++row)
    for (std::uint32_t column = 0; column <= cells; ++column) {
      const double x = 1.5 * column / cells - 0.75;
      const double y = 1.5 * row / cells - 0.75;
      shape.positions.emplace_back(x, y, height(x, y));
    }
  add_cells(shape, 0, cells, cells, quads, random);
  return shape;
}

Shape random_terrain(Random& random) {
  const double rough = random.between(0, 0.3);
  const std::uint32_t cells = 2 + random.below(4);
  const double quads = random.below(3) * 0.5;
  return sheet_of(cells, quads, random, [&](double, double) { return rough * random.between(-1, 1); });
}

/// A roof whose two sides meet at nearly the angle at which an edge becomes a crease, in ulps.
Shape random_roof(Random& random) {
  const double limit = std::sqrt(1.0 / 127);
  const double slope = limit * (1 + (random.below(9) - 4.0) * 0x1p-52);
  const bool is_ridge = random.chance(0.5);
  return sheet_of(2, random.below(3) * 0.5, random,
                  [&](double, double y) { return y <= 0 ? 0.0 : (is_ridge ? -slope : slope) * y; });
}

/// A box of quads of which corners are moved, so that none is flat.
Shape random_warped(Random& random) {
  const Vector3d half = random_half(random);
  Shape shape = box_of(half, 1 + random.below(2), 1, random);
  for (Vector3d& position : shape.positions) position += random.vector(-0.08, 0.08);
  return shape;
}

/// A box that lacks some faces.
Shape random_open_box(Random& random) {
  Shape shape = random_crate(random);
  for (int i = 0; i < 2; ++i)
    shape.faces.erase(shape.faces.begin() + static_cast<std::ptrdiff_t>(random.below(
                                                static_cast<std::uint32_t>(shape.faces.size()))));
  return shape;
}

/// Two to four pages that share an edge, of triangles and quads. Some are turned over.
Shape random_pages(Random& random) {
  Shape shape;
  shape.positions = {{-0.5, 0, 0}, {0.5, 0, 0}};
  const std::uint32_t pages = 2 + random.below(3);
  for (std::uint32_t page = 0; page < pages; ++page) {
    const double angle = random.between(0, 2 * std::numbers::pi);
    const Vector3d across(0, 0.5 * std::cos(angle), 0.5 * std::sin(angle));
    const auto next = static_cast<std::uint32_t>(shape.positions.size());
    shape.positions.push_back(shape.positions[1] + across);
    std::vector<std::uint32_t> face{0, 1, next};
    if (random.chance(0.5)) {
      shape.positions.push_back(shape.positions[0] + across + random.vector(-0.1, 0.1));
      face.push_back(next + 1);
    }
    if (random.chance(0.3)) std::reverse(face.begin(), face.end());
    shape.faces.push_back(face);
  }
  return shape;
}

Shape random_plate(Random& random) {
  Vector3d half = random_half(random);
  half.z() = random.between(0.002, 0.02);
  const double quads = random.below(3) * 0.5;
  return box_of(half, 1 + random.below(2), quads, random);
}

Shape random_form(Random& random) {
  using Make = Shape (*)(Random&);
  static constexpr std::array<Make, 12> forms = {
      random_crate,   random_crate, random_crate,  random_ball,     random_hull,  random_terrain,
      random_terrain, random_roof,  random_warped, random_open_box, random_pages, random_plate};
  return forms[random.below(forms.size())](random);
}

Vector3d lowest(const Shape& shape) {
  Vector3d low = shape.positions[0];
  for (const Vector3d& p : shape.positions) low = low.cwiseMin(p);
  return low;
}

Vector3d highest(const Shape& shape) {
  Vector3d high = shape.positions[0];
  for (const Vector3d& p : shape.positions) high = high.cwiseMax(p);
  return high;
}

void shift(Shape& shape, const Vector3d& by) {
  for (Vector3d& position : shape.positions) position += by;
}

Shape turned_at_random(const Shape& shape, Random& random) {
  const Vector3d axis = random.vector(-1, 1) + Vector3d(0, 0, 1e-3);
  return turned_about(shape, axis, random.between(0, 6));
}

/// Puts b over a: the lowest point of b is `gap` over the highest of a, and their middles are near.
void put_on(CreaseScene& scene, double gap, Random& random) {
  const Vector3d size = highest(scene.a) - lowest(scene.a);
  const double x = random.between(-0.4, 0.4) * size.x();
  const double y = random.between(-0.4, 0.4) * size.y();
  const Vector3d middle = (highest(scene.b) + lowest(scene.b)) / 2;
  shift(scene.b, {x - middle.x(), y - middle.y(), highest(scene.a).z() + gap - lowest(scene.b).z()});
}

double random_gap(Lie lie, double threshold, Random& random) {
  if (lie == Lie::sunk) return -threshold * random.between(0.01, 1);
  if (lie == Lie::plates && random.chance(0.4)) return -0.004 * random.between(0.1, 1);
  return random.chance(0.2) ? 0 : threshold * random.between(0.05, 0.9);
}

void lay(CreaseScene& scene, Random& random) {
  const Lie lie = scene.lie;
  if (lie == Lie::crossing || lie == Lie::deep) {
    scene.b = turned_at_random(scene.b, random);
    const Shape& a = scene.a;
    const Vector3d on_surface = a.positions[random.below(static_cast<std::uint32_t>(a.positions.size()))];
    const Vector3d near = lie == Lie::deep ? Vector3d(0, 0, 0) : on_surface;
    shift(scene.b, near + random.vector(-0.2, 0.2));
    return;
  }
  if (lie == Lie::hulls) {
    scene.b = turned_at_random(scene.b, random);
  } else {
    if (random.chance(0.8)) scene.b = turned_about(scene.b, {0, 0, 1}, random.between(0, 6));
    const bool is_tilted = lie == Lie::tilted || (lie != Lie::resting && random.chance(0.5));
    if (is_tilted) {
      const double x = random.between(-1, 1);
      const Vector3d axis(x, random.between(-1, 1), 0);
      scene.b = turned_about(scene.b, axis + Vector3d(1e-3, 0, 0), random.chance(0.5) ? 1e-6 : 1e-3);
    }
  }
  put_on(scene, random_gap(lie, scene.threshold, random), random);
}

void deform(Shape& shape, double size, Random& random) {
  for (Vector3d& position : shape.positions) position += random.vector(-size, size);
}

void scale(CreaseScene& scene, double factor) {
  for (Shape* shape : {&scene.rest_a, &scene.rest_b, &scene.a, &scene.b})
    for (Vector3d& position : shape->positions) position *= factor;
  scene.threshold *= factor;
}

}  // namespace

Shape turned_about(Shape shape, const Eigen::Vector3d& axis, double angle) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  for (Vector3d& position : shape.positions) position = turn * position;
  return shape;
}

CreaseScene random_creases(std::uint64_t seed) {
  Random random(seed);
  CreaseScene scene;
  scene.lie = static_cast<Lie>(seed % lie_count);
  scene.threshold = random.chance(0.4) ? random.between(0.15, 0.5) : random.between(0.02, 0.15);
  const bool are_plates = scene.lie == Lie::plates;
  scene.rest_a = are_plates ? random_plate(random) : random_form(random);
  scene.rest_b = are_plates ? random_plate(random) : random_form(random);
  scene.a = scene.rest_a;
  scene.b = scene.rest_b;
  if (random.chance(0.3)) {
    scene.is_deformed = true;
    const double size = random.between(0, are_plates ? 0.002 : 0.1);
    deform(scene.a, size, random);
    if (random.chance(0.5)) deform(scene.b, size, random);
  }
  lay(scene, random);
  if (random.chance(0.05)) scale(scene, random.chance(0.5) ? 0x1p100 : 0x1p-100);
  return scene;
}

void move_a_little(CreaseScene& scene, Random& random) {
  const double size = scene.threshold * random.between(0, 0.3);
  if (random.chance(0.3)) {
    Shape& shape = random.chance(0.5) ? scene.a : scene.b;
    shape.positions[random.below(static_cast<std::uint32_t>(shape.positions.size()))] +=
        random.vector(-size, size);
  }
  if (random.chance(0.3)) shift(scene.a, random.vector(-size, size));
  if (random.chance(0.3)) {
    const Vector3d axis = random.vector(-1, 1) + Vector3d(0, 0, 1e-3);
    scene.b = turned_about(scene.b, axis, random.chance(0.5) ? 1e-6 : 0.02);
  } else if (random.chance(0.8)) {
    shift(scene.b, random.vector(-size, size));
  }
}

}  // namespace graze::oracle
