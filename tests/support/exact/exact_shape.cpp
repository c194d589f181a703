#include "support/exact/exact_shape.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace graze::oracle {

namespace {

static_assert(std::numeric_limits<long double>::max_exponent > 2 * 1024 + 64);

using EdgeNumbers = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

/// The corner pair from `corner` to the next, lower vertex first.
std::pair<std::uint32_t, std::uint32_t> side(const std::vector<std::uint32_t>& face, std::size_t corner) {
  const std::uint32_t from = face[corner];
  const std::uint32_t to = face[(corner + 1) % face.size()];
  return {std::min(from, to), std::max(from, to)};
}

bool contains(const std::vector<std::uint32_t>& values, std::uint32_t value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

EdgeNumbers number_of_edges(const std::vector<std::array<std::uint32_t, 2>>& edges) {
  EdgeNumbers numbers;
  for (std::uint32_t i = 0; i < edges.size(); ++i) numbers[{edges[i][0], edges[i][1]}] = i;
  return numbers;
}

Triangle triangle_of(const std::vector<Point>& points, std::array<std::uint32_t, 3> corners, int inner_side) {
  const Point& origin = points[corners[0]];
  return {corners, inner_side, cross(points[corners[1]] - origin, points[corners[2]] - origin)};
}

/// Whether the ends of a quad's diagonal are two vertices that no edge of the quad joins.
bool has_inner_diagonal(const std::vector<std::uint32_t>& corners) {
  if (corners.size() != 4 || corners[0] == corners[2]) return false;
  return corners[1] != corners[0] && corners[1] != corners[2] && corners[3] != corners[0] &&
         corners[3] != corners[2];
}

Face face_of(const Shape& shape, const std::vector<Point>& points, const EdgeNumbers& numbers,
             const std::vector<std::uint32_t>& corners) {
  Face face;
  face.corners = corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [low, high] = side(corners, i);
    if (low != high && !contains(face.edges, numbers.at({low, high})))
      face.edges.push_back(numbers.at({low, high}));
  }
  const bool inner = has_inner_diagonal(corners);
  const int no_side = Triangle::no_side;
  face.triangles.push_back(triangle_of(points, {corners[0], corners[1], corners[2]}, inner ? 2 : no_side));
  if (corners.size() == 4)
    face.triangles.push_back(triangle_of(points, {corners[0], corners[2], corners[3]}, inner ? 0 : no_side));
  face.extent = extent_of(shape, corners);
  return face;
}

Segment diagonal_of(const Shape& shape, const std::vector<Point>& points, std::uint32_t index,
                    const Face& face) {
  const std::array<std::uint32_t, 2> ends{face.corners[0], face.corners[2]};
  Segment diagonal{ends, {FeatureKind::face, index}, false, false, extent_of(shape, ends)};
  const Point& normal = face.triangles[0].normal;
  diagonal.fold = dot(normal, points[face.corners[3]] - points[face.corners[0]]) != 0;
  diagonal.folded_over = !diagonal.fold && dot(normal, face.triangles[1].normal) < 0;
  return diagonal;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> edges_of(const Shape& shape) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  EdgeNumbers numbers;
  for (const auto& face : shape.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const auto [low, high] = side(face, i);
      if (low == high) continue;
      if (numbers.try_emplace({low, high}, static_cast<std::uint32_t>(edges.size())).second)
        edges.push_back({low, high});
    }
  }
  return edges;
}

Extent extent_of(const Shape& shape, std::span<const std::uint32_t> vertices) {
  Extent extent{shape.positions[vertices[0]], shape.positions[vertices[0]]};
  for (const std::uint32_t vertex : vertices) {
    extent.min = extent.min.cwiseMin(shape.positions[vertex]);
    extent.max = extent.max.cwiseMax(shape.positions[vertex]);
  }
  return extent;
}

long double gap_squared(const Extent& a, const Extent& b) {
  long double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const long double below = static_cast<long double>(a.min[axis]) - b.max[axis];
    const long double above = static_cast<long double>(b.min[axis]) - a.max[axis];
    const long double gap = std::max({below, above, 0.0L});
    sum += gap * gap;
  }
  return sum;
}

Limit Limit::below(double threshold) {
  Limit limit;
  const double reach = std::max(threshold, 0.0);
  limit.squared_ = Rational(reach) * Rational(reach);
  limit.reach_squared_ = static_cast<long double>(reach) * reach;
  return limit;
}

Limit Limit::up_to(const Rational& distance_squared) {
  Limit limit;
  limit.squared_ = distance_squared;
  limit.inclusive_ = true;
  const long double reach = round_sqrt(distance_squared, Rounding::up);
  limit.reach_squared_ = reach * reach;
  return limit;
}

Limit Limit::none() {
  Limit limit;
  limit.endless_ = true;
  limit.reach_squared_ = std::numeric_limits<long double>::infinity();
  return limit;
}

bool Limit::admits(const Rational& distance_squared) const {
  if (endless_) return true;
  return inclusive_ ? distance_squared <= squared_ : distance_squared < squared_;
}

bool Limit::certainly_excludes(const Extent& a, const Extent& b) const {
  return gap_squared(a, b) > reach_squared_ * 1.0001L;
}

ExactShape::ExactShape(const Shape& shape)
    : points(shape.positions.size()), point_extents(shape.positions.size()) {
  std::vector<bool> is_used(shape.positions.size(), false);
  for (const auto& face : shape.faces)
    for (const std::uint32_t corner : face) is_used.at(corner) = true;
  for (std::uint32_t i = 0; i < is_used.size(); ++i) {
    if (!is_used[i]) continue;
    used.push_back(i);
    points[i] = exact(shape.positions[i]);
    point_extents[i] = {shape.positions[i], shape.positions[i]};
  }

  const auto edges = edges_of(shape);
  edge_count = edges.size();
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    segments.push_back({edges[i], {FeatureKind::edge, i}, false, false, extent_of(shape, edges[i])});
  const EdgeNumbers numbers = number_of_edges(edges);
  for (std::uint32_t i = 0; i < shape.faces.size(); ++i) {
    faces.push_back(face_of(shape, points, numbers, shape.faces[i]));
    if (has_inner_diagonal(shape.faces[i])) segments.push_back(diagonal_of(shape, points, i, faces[i]));
  }
}

bool ExactShape::is_part(Feature part, Feature whole) const {
  if (part == whole) return true;
  if (part.kind == FeatureKind::vertex && whole.kind == FeatureKind::edge) {
    const auto& ends = segments[whole.index].ends;
    return part.index == ends[0] || part.index == ends[1];
  }
  if (whole.kind != FeatureKind::face) return false;
  if (part.kind == FeatureKind::vertex) return contains(faces[whole.index].corners, part.index);
  return part.kind == FeatureKind::edge && contains(faces[whole.index].edges, part.index);
}

}  // namespace graze::oracle
