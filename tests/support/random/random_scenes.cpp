#include "support/random/random_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/exact/exact_shape.hpp"

namespace graze::oracle {

namespace {

constexpr double grid_step = 0.25;

/// Draws random positions for the vertices of a scene, on a grid or off it.
class Space {
 public:
  Space(Random& random, bool on_grid) : random_(random), on_grid_(on_grid) {}

  Eigen::Vector3d point() {
    const double x = coordinate();
    const double y = coordinate();
    return {x, y, coordinate()};
  }
  double length(double low, double high) {
    const double value = random_.between(low, high);
    return on_grid_ ? grid_step * std::round(value / grid_step) : value;
  }

 private:
  double coordinate() { return on_grid_ ? grid_step * random_.below(5) : random_.between(0, 1); }

  Random& random_;
  bool on_grid_;
};

std::uint32_t last_vertex(const Shape& shape) {
  return static_cast<std::uint32_t>(shape.positions.size()) - 1;
}

std::uint32_t new_vertex(Shape& shape, Space& space) {
  shape.positions.push_back(space.point());
  return last_vertex(shape);
}

/// Faces over a handful of vertices, which they share at random: neither manifold nor even clean.
Shape random_soup(Random& random, Space& space) {
  Shape shape;
  const std::uint32_t face_count = 1 + random.below(6);
  for (std::uint32_t i = 0; i < face_count; ++i) {
    std::vector<std::uint32_t> corners(3 + random.below(2));
    for (std::uint32_t& corner : corners) {
      const bool old = !shape.positions.empty() && random.chance(0.4);
      corner = old ? random.below(last_vertex(shape) + 1) : new_vertex(shape, space);
    }
    shape.faces.push_back(corners);
  }
  return shape;
}

/// An open sheet of 1 to 3 by 1 to 4 cells. Each is a quad, flat or warped, or two triangles.
Shape random_sheet(Random& random, Space& space) {
  Shape shape;
  const std::uint32_t rows = 1 + random.below(3);
  const std::uint32_t columns = 1 + random.below(4);
  const double bump = random.chance(0.5) ? space.length(0.1, 0.6) : 0;
  const double step_x = space.length(0.2, 0.6);
  const double step_y = space.length(0.2, 0.6);
  const Eigen::Vector3d corner = space.point();
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const double height = random.chance(0.5) ? bump : 0;
      shape.positions.emplace_back(corner + Eigen::Vector3d(step_x * column, step_y * row, height));
    }
  }
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t low = row * (columns + 1) + column;
      const std::uint32_t high = low + columns + 1;
      if (random.chance(0.7) || shape.faces.size() + rows * columns > 11) {
        shape.faces.push_back({low, low + 1, high + 1, high});
      } else {
        shape.faces.push_back({low, low + 1, high + 1});
        shape.faces.push_back({low, high + 1, high});
      }
    }
  }
  return shape;
}

/// A closed box of six quads or twelve triangles. One corner may be moved, which warps three quads.
Shape random_box(Random& random, Space& space) {
  Shape shape;
  const Eigen::Vector3d size{space.length(0.25, 1), space.length(0.25, 1), space.length(0.25, 1)};
  const Eigen::Vector3d corner = space.point();
  for (std::uint32_t i = 0; i < 8; ++i)
    shape.positions.emplace_back(corner +
                                 size.cwiseProduct(Eigen::Vector3d(i & 1U, (i >> 1U) & 1U, i >> 2U)));
  if (random.chance(0.4)) shape.positions[random.below(8)] = space.point();
  const std::vector<std::vector<std::uint32_t>> quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const bool triangles = random.chance(0.4);
  for (const auto& quad : quads) {
    if (triangles) {
      shape.faces.push_back({quad[0], quad[1], quad[2]});
      shape.faces.push_back({quad[0], quad[2], quad[3]});
    } else {
      shape.faces.push_back(quad);
    }
  }
  return shape;
}

/// A closed tetrahedron.
Shape random_tetrahedron(Space& space) {
  Shape shape;
  for (int i = 0; i < 4; ++i) new_vertex(shape, space);
  shape.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return shape;
}

/// Puts a vertex that no face uses at the front, where a careless reader would read it.
void add_unused_vertex(Shape& shape) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  shape.positions.insert(shape.positions.begin(), Eigen::Vector3d(nothing, nothing, nothing));
  for (auto& face : shape.faces)
    for (std::uint32_t& corner : face) ++corner;
}

Shape random_shape(Random& random, bool on_grid) {
  Space space(random, on_grid);
  const std::uint32_t form = random.below(4);
  Shape shape = form == 0   ? random_soup(random, space)
                : form == 1 ? random_sheet(random, space)
                : form == 2 ? random_box(random, space)
                            : random_tetrahedron(space);
  if (random.chance(0.25)) add_unused_vertex(shape);
  return shape;
}

Extent used_extent(const Shape& shape) {
  std::vector<std::uint32_t> used;
  for (const auto& face : shape.faces) used.insert(used.end(), face.begin(), face.end());
  return extent_of(shape, used);
}

/// Moves `shape` along one axis until its box begins `gap` above where `other`'s ends.
void place_beside(Shape& shape, const Shape& other, int axis, double gap) {
  const double offset = used_extent(other).max[axis] + gap - used_extent(shape).min[axis];
  for (Eigen::Vector3d& position : shape.positions) position[axis] += offset;
}

/// Moves `shape` so that one of its used vertices lies on a used vertex, on the middle of a side or of a
/// diagonal of `other`.
void make_touch(Shape& shape, const Shape& other, Random& random) {
  const auto& own = shape.faces[random.below(static_cast<std::uint32_t>(shape.faces.size()))];
  const auto& face = other.faces[random.below(static_cast<std::uint32_t>(other.faces.size()))];
  const auto corner = [&random](const std::vector<std::uint32_t>& corners) {
    return corners[random.below(static_cast<std::uint32_t>(corners.size()))];
  };
  const Eigen::Vector3d first = other.positions[corner(face)];
  const Eigen::Vector3d second = other.positions[corner(face)];
  const Eigen::Vector3d target = (first + second) / 2;
  const Eigen::Vector3d offset = target - shape.positions[corner(own)];
  for (Eigen::Vector3d& position : shape.positions) position += offset;
}

bool has_parallel_edges(const ExactShape& a, const ExactShape& b) {
  for (const Segment& p : a.edges()) {
    const Point u = a.points[p.ends[1]] - a.points[p.ends[0]];
    for (const Segment& q : b.edges()) {
      const Point v = b.points[q.ends[1]] - b.points[q.ends[0]];
      if (!is_zero(u) && !is_zero(v) && is_zero(cross(u, v))) return true;
    }
  }
  return false;
}

}  // namespace

RandomScene random_scene(std::uint64_t seed) {
  Random random(seed);
  RandomScene scene;
  scene.on_grid = seed % 2 == 1;
  scene.placement = static_cast<Placement>(seed / 2 % 4);
  scene.a = random_shape(random, scene.on_grid);
  scene.b = random_shape(random, scene.on_grid);
  Space space(random, scene.on_grid);
  scene.threshold = std::max(space.length(0, 0.5), scene.placement == Placement::near ? grid_step : 0.0);
  const int axis = static_cast<int>(random.below(3));
  if (scene.placement == Placement::apart)
    place_beside(scene.b, scene.a, axis, scene.threshold + space.length(0, 1));
  if (scene.placement == Placement::near) place_beside(scene.b, scene.a, axis, scene.threshold * 0.5);
  if (scene.placement == Placement::touching) make_touch(scene.b, scene.a, random);
  return scene;
}

void Coverage::count(const RandomScene& scene, const std::vector<Named>& features,
                     const std::optional<Named>& closest, const Pair& surface) {
  const ExactShape a(scene.a);
  const ExactShape b(scene.b);
  for (const Named& contact : features) {
    ++kinds[static_cast<std::size_t>(contact.kind)];
    if (contact.pierced) {
      ++piercings;
    } else {
      if (contact.kind == ContactKind::EF || contact.kind == ContactKind::FF) ++folds;
      if (contact.distance_squared == 0) ++zero_distances;
    }
  }
  if (closest) ++closest_kinds[static_cast<std::size_t>(closest->kind)];
  if (!closest) ++without_contact;
  for (const ExactShape* shape : {&a, &b}) {
    for (const Face& face : shape->faces)
      for (const Triangle& triangle : face.triangles) degenerate_faces += is_zero(triangle.normal) ? 1U : 0U;
    for (const Segment& segment : shape->segments) warped_quads += segment.fold ? 1U : 0U;
  }
  if (has_parallel_edges(a, b)) ++parallel_edges;
  const Rational threshold(scene.threshold);
  if (surface.distance_squared == threshold * threshold) ++at_threshold;
}

}  // namespace graze::oracle
