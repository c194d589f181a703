#include "support/exact/exact_distance.hpp"

#include <array>
#include <utility>

namespace graze::oracle {

namespace {

/// Keeps the closer foot. On a tie it is the lower feature, then the one kept before.
void keep_nearer(Foot& best, Foot candidate) {
  const int order = cmp(candidate.distance_squared, best.distance_squared);
  if (order < 0 || (order == 0 && candidate.feature < best.feature)) best = std::move(candidate);
}

Foot foot_on_vertex(const Point& point, const ExactShape& shape, std::uint32_t vertex) {
  const Point& corner = shape.points[vertex];
  return {{FeatureKind::vertex, vertex}, corner, squared_length(point - corner)};
}

/// The foot of a point on a segment. None if it is not between the ends.
std::optional<Foot> foot_inside_segment(const Point& point, const ExactShape& shape, const Segment& segment) {
  const Point& start = shape.points[segment.ends[0]];
  const Point along = shape.points[segment.ends[1]] - start;
  const Point from_start = point - start;
  const Rational way = dot(from_start, along);
  if (way <= 0) return std::nullopt;
  const Rational length_squared = squared_length(along);
  if (way >= length_squared) return std::nullopt;
  const Rational t = way / length_squared;
  return Foot{segment.owner, start + t * along, Rational(squared_length(from_start) - t * way)};
}

std::optional<Foot> foot_inside_triangle(const Point& point, const ExactShape& shape, std::uint32_t face,
                                         const Triangle& triangle) {
  if (is_zero(triangle.normal)) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& from = shape.points[triangle.corners[i]];
    const Point& to = shape.points[triangle.corners[(i + 1) % 3]];
    if (dot(cross(to - from, point - from), triangle.normal) <= 0) return std::nullopt;
  }
  const Rational height = dot(point - shape.points[triangle.corners[0]], triangle.normal);
  const Rational length_squared = squared_length(triangle.normal);
  return Foot{{FeatureKind::face, face},
              point - Rational(height / length_squared) * triangle.normal,
              Rational(height * height / length_squared)};
}

/// Twice the signed area that a line from `from` along `direction` sees of each side of a triangle: all of
/// one sign where it passes strictly inside, zero for a side that it meets.
std::array<int, 3> side_signs(const Point& from, const Point& direction, const ExactShape& shape,
                              const Triangle& triangle) {
  std::array<int, 3> signs{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point p = shape.points[triangle.corners[i]] - from;
    const Point q = shape.points[triangle.corners[(i + 1) % 3]] - from;
    signs[i] = sgn(dot(direction, cross(p, q)));
  }
  return signs;
}

bool is_inside(const std::array<int, 3>& signs, int inner_side) {
  int expected = 0;
  for (int i = 0; i < 3; ++i) {
    const int sign = signs[static_cast<std::size_t>(i)];
    if (sign == 0 && i == inner_side) continue;
    if (sign == 0 || (expected != 0 && sign != expected)) return false;
    expected = sign;
  }
  return true;
}

std::optional<Rational> triangle_crossing(const Point& from, const Point& to, const ExactShape& shape,
                                          const Triangle& triangle) {
  const Point& origin = shape.points[triangle.corners[0]];
  const Rational height_from = dot(from - origin, triangle.normal);
  const Rational height_to = dot(to - origin, triangle.normal);
  if (sgn(height_from) * sgn(height_to) >= 0) return std::nullopt;
  if (!is_inside(side_signs(from, to - from, shape, triangle), triangle.inner_side)) return std::nullopt;
  return Rational(height_from / (height_from - height_to));
}

bool has_length(const ExactShape& shape, const Segment& segment) {
  return !is_zero(shape.points[segment.ends[1]] - shape.points[segment.ends[0]]);
}

/// How many ends of a segment stand for it: one where it is a point.
std::size_t end_count(const ExactShape& shape, const Segment& segment) {
  return has_length(shape, segment) ? 2 : 1;
}

}  // namespace

Point point_at(const ExactShape& shape, const Segment& segment, const Rational& t) {
  const Point& start = shape.points[segment.ends[0]];
  return start + t * (shape.points[segment.ends[1]] - start);
}

Foot foot_on_segment(const Point& point, const ExactShape& shape, const Segment& segment) {
  if (std::optional<Foot> inside = foot_inside_segment(point, shape, segment)) return std::move(*inside);
  Foot first = foot_on_vertex(point, shape, segment.ends[0]);
  if (!has_length(shape, segment)) return first;
  keep_nearer(first, foot_on_vertex(point, shape, segment.ends[1]));
  return first;
}

Foot foot_on_face(const Point& point, const ExactShape& shape, std::uint32_t index) {
  const Face& face = shape.faces[index];
  Foot best = foot_on_vertex(point, shape, face.corners[0]);
  for (const std::uint32_t corner : face.corners) keep_nearer(best, foot_on_vertex(point, shape, corner));
  for (const std::uint32_t edge : face.edges) {
    if (auto foot = foot_inside_segment(point, shape, shape.segments[edge]))
      keep_nearer(best, std::move(*foot));
  }
  for (const Triangle& triangle : face.triangles) {
    if (auto foot = foot_inside_triangle(point, shape, index, triangle)) keep_nearer(best, std::move(*foot));
    if (triangle.inner_side == Triangle::no_side) continue;
    const Segment diagonal{{face.corners[0], face.corners[2]}, {FeatureKind::face, index}, false, false, {}};
    if (auto foot = foot_inside_segment(point, shape, diagonal)) keep_nearer(best, std::move(*foot));
  }
  return best;
}

std::optional<SegmentContact> inner_contact(const ExactShape& a, const Segment& segment_a,
                                            const ExactShape& b, const Segment& segment_b) {
  const Point u = a.points[segment_a.ends[1]] - a.points[segment_a.ends[0]];
  const Point v = b.points[segment_b.ends[1]] - b.points[segment_b.ends[0]];
  const Point normal = cross(u, v);
  const Rational normal_squared = squared_length(normal);
  if (normal_squared == 0) return std::nullopt;
  const Point between = b.points[segment_b.ends[0]] - a.points[segment_a.ends[0]];
  Rational s = dot(cross(between, v), normal);
  if (s <= 0 || s >= normal_squared) return std::nullopt;
  Rational t = dot(cross(between, u), normal);
  if (t <= 0 || t >= normal_squared) return std::nullopt;
  s /= normal_squared;
  t /= normal_squared;
  const Rational height = dot(between, normal);
  const Rational distance_squared = height * height / normal_squared;
  return SegmentContact{{segment_a.owner, point_at(a, segment_a, s), distance_squared},
                        {segment_b.owner, point_at(b, segment_b, t), distance_squared}};
}

std::vector<SegmentContact> end_contacts(const ExactShape& a, const Segment& segment_a, const ExactShape& b,
                                         const Segment& segment_b) {
  std::vector<SegmentContact> nearest;
  const auto keep = [&nearest](Foot on_a, Foot on_b) {
    if (!nearest.empty()) {
      const int order = cmp(on_a.distance_squared, nearest[0].a.distance_squared);
      if (order > 0) return;
      if (order < 0) nearest.clear();
    }
    nearest.push_back({std::move(on_a), std::move(on_b)});
  };
  for (std::size_t i = 0; i < end_count(a, segment_a); ++i) {
    const std::uint32_t end = segment_a.ends[i];
    Foot foot = foot_on_segment(a.points[end], b, segment_b);
    Foot on_a{{FeatureKind::vertex, end}, a.points[end], foot.distance_squared};
    keep(std::move(on_a), std::move(foot));
  }
  for (std::size_t i = 0; i < end_count(b, segment_b); ++i) {
    const std::uint32_t end = segment_b.ends[i];
    Foot foot = foot_on_segment(b.points[end], a, segment_a);
    Foot on_b{{FeatureKind::vertex, end}, b.points[end], foot.distance_squared};
    keep(std::move(foot), std::move(on_b));
  }
  return nearest;
}

std::optional<Rational> crossing(const ExactShape& shape, const Segment& segment, const ExactShape& other,
                                 std::uint32_t face) {
  const Point& from = shape.points[segment.ends[0]];
  const Point& to = shape.points[segment.ends[1]];
  std::optional<Rational> first;
  for (const Triangle& triangle : other.faces[face].triangles) {
    std::optional<Rational> t = triangle_crossing(from, to, other, triangle);
    if (t && (!first || *t < *first)) first = std::move(t);
  }
  return first;
}

}  // namespace graze::oracle
