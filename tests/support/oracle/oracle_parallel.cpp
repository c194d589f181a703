#include "support/oracle/oracle_parallel.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace graze::oracle {

namespace {

/// A stretch of a segment, as fractions of the way from its first end.
struct Stretch {
  Rational from, to;
};

/// Part of the plane of a triangle, convex, in order around it.
using Polygon = std::vector<Point>;

Point along(const ExactShape& shape, const Segment& segment) {
  return shape.points[segment.ends[1]] - shape.points[segment.ends[0]];
}

/// The vector from the plane of a triangle to a point.
Point height_vector(const ExactShape& shape, const Triangle& triangle, const Point& point) {
  const Rational height = dot(point - shape.points[triangle.corners[0]], triangle.normal);
  return Rational(height / squared_length(triangle.normal)) * triangle.normal;
}

/// How far a point lies to the inner side of one side of a triangle, up to a positive factor. Zero on the
/// side's line.
Rational inwardness(const ExactShape& shape, const Triangle& triangle, std::size_t side, const Point& point) {
  const Point& from = shape.points[triangle.corners[side]];
  const Point& to = shape.points[triangle.corners[(side + 1) % 3]];
  return dot(cross(to - from, point - from), triangle.normal);
}

// --- two edges ---

std::optional<ExactContact> parallel_edges(const ExactShape& a, const Segment& edge_a, const ExactShape& b,
                                           const Segment& edge_b, const Rational& distance_squared) {
  const Point u = along(a, edge_a);
  const Point v = along(b, edge_b);
  if (is_zero(u) || is_zero(v) || !is_zero(cross(u, v))) return std::nullopt;
  const Point& origin = a.points[edge_a.ends[0]];
  const Rational length_squared = squared_length(u);
  const Rational p = dot(b.points[edge_b.ends[0]] - origin, u) / length_squared;
  const Rational q = dot(b.points[edge_b.ends[1]] - origin, u) / length_squared;
  const Rational from = std::max(Rational(0), std::min(p, q));
  const Rational to = std::min(Rational(1), std::max(p, q));
  if (from >= to) return std::nullopt;
  const Point across = b.points[edge_b.ends[0]] - (origin + p * u);
  if (squared_length(across) != distance_squared) return std::nullopt;
  const Point middle = point_at(a, edge_a, Rational((from + to) / 2));
  return ExactContact{distance_squared, middle, middle + across, false};
}

// --- an edge and a face ---

/// The stretch of an edge, parallel to a triangle, that lies over the triangle's inside or its inner
/// diagonal.
std::optional<Stretch> stretch_over(const ExactShape& shape, const Segment& edge, const ExactShape& other,
                                    const Triangle& triangle) {
  const Point& start = shape.points[edge.ends[0]];
  const Point& end = shape.points[edge.ends[1]];
  Stretch stretch{0, 1};
  for (std::size_t side = 0; side < 3; ++side) {
    const Rational at_start = inwardness(other, triangle, side, start);
    const Rational at_end = inwardness(other, triangle, side, end);
    if (at_start == at_end) {
      if (at_start < 0 || (at_start == 0 && triangle.inner_side != static_cast<int>(side)))
        return std::nullopt;
      continue;
    }
    const Rational meets = at_start / (at_start - at_end);
    if (at_end > at_start) {
      stretch.from = std::max(stretch.from, meets);
    } else {
      stretch.to = std::min(stretch.to, meets);
    }
  }
  if (stretch.from >= stretch.to) return std::nullopt;
  return stretch;
}

/// Joins stretches that meet and returns the longest, on a tie the first.
Stretch longest_joined(std::vector<Stretch> stretches) {
  if (stretches.size() == 2) {
    const Stretch& p = stretches[0];
    const Stretch& q = stretches[1];
    if (p.from <= q.to && q.from <= p.to) return {std::min(p.from, q.from), std::max(p.to, q.to)};
    if (q.to - q.from > p.to - p.from) return q;
  }
  return stretches[0];
}

std::optional<ExactContact> edge_over_face(const ExactShape& shape, const Segment& edge,
                                           const ExactShape& other, std::uint32_t face,
                                           const Rational& distance_squared) {
  const Point u = along(shape, edge);
  if (is_zero(u)) return std::nullopt;
  std::vector<Stretch> stretches;
  std::vector<Point> heights;
  for (const Triangle& triangle : other.faces[face].triangles) {
    if (is_zero(triangle.normal) || dot(u, triangle.normal) != 0) continue;
    const Point height = height_vector(other, triangle, shape.points[edge.ends[0]]);
    if (squared_length(height) != distance_squared) continue;
    if (auto stretch = stretch_over(shape, edge, other, triangle)) {
      stretches.push_back(std::move(*stretch));
      heights.push_back(height);
    }
  }
  if (stretches.empty()) return std::nullopt;
  const bool one_plane = stretches.size() == 1 || is_zero(heights[0] - heights[1]);
  if (!one_plane) {
    const bool second = stretches[1].to - stretches[1].from > stretches[0].to - stretches[0].from;
    stretches = {stretches[second ? 1 : 0]};
    if (second) heights[0] = heights[1];
  }
  const Stretch stretch = longest_joined(std::move(stretches));
  const Point middle = point_at(shape, edge, Rational((stretch.from + stretch.to) / 2));
  return ExactContact{distance_squared, middle, middle - heights[0], false};
}

// --- two faces ---

/// The part of a convex polygon on the inner side of one side of a triangle, border included.
Polygon clipped(const Polygon& polygon, const ExactShape& shape, const Triangle& triangle, std::size_t side) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    const Rational at_p = inwardness(shape, triangle, side, p);
    const Rational at_q = inwardness(shape, triangle, side, q);
    if (at_p >= 0) result.push_back(p);
    if (sgn(at_p) * sgn(at_q) < 0) result.push_back(p + Rational(at_p / (at_p - at_q)) * (q - p));
  }
  return result;
}

/// Twice the area of a polygon in the plane of `normal`, times the length of `normal`.
Rational area(const Polygon& polygon, const Point& normal) {
  Rational sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += dot(cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]), normal);
  return abs(sum);
}

Point weighted_centroid(const Polygon& polygon, const Point& normal) {
  Point sum{0, 0, 0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Polygon part{polygon[0], polygon[i], polygon[i + 1]};
    sum = sum + Rational(area(part, normal) / 3) * (part[0] + part[1] + part[2]);
  }
  return sum;
}

/// The overlap of two parallel triangles: its polygon on a's triangle, and the vector across to b's.
struct Overlap {
  Polygon on_a;
  Point across;
  Point normal;  ///< of a's triangle
  std::size_t group = 0;
};

std::optional<Overlap> overlap_of(const ExactShape& a, const Triangle& triangle_a, const ExactShape& b,
                                  const Triangle& triangle_b, const Rational& distance_squared) {
  if (is_zero(triangle_a.normal) || is_zero(triangle_b.normal)) return std::nullopt;
  if (!is_zero(cross(triangle_a.normal, triangle_b.normal))) return std::nullopt;
  const Point across = height_vector(a, triangle_a, b.points[triangle_b.corners[0]]);
  if (squared_length(across) != distance_squared) return std::nullopt;
  Polygon polygon;
  for (const std::uint32_t corner : triangle_b.corners) polygon.push_back(b.points[corner] - across);
  for (std::size_t side = 0; side < 3; ++side) polygon = clipped(polygon, a, triangle_a, side);
  if (area(polygon, triangle_a.normal) == 0) return std::nullopt;
  return Overlap{std::move(polygon), across, triangle_a.normal};
}

/// Whether two pieces lie in one plane and have a point in common: no side of either keeps them apart.
bool meet(const Overlap& p, const Overlap& q) {
  if (!is_zero(cross(p.normal, q.normal)) || !is_zero(p.across - q.across)) return false;
  if (dot(q.on_a[0] - p.on_a[0], p.normal) != 0) return false;
  const auto separates = [](const Overlap& one, const Overlap& other) {
    for (std::size_t i = 0; i < one.on_a.size(); ++i) {
      const Point& from = one.on_a[i];
      const Point side = one.on_a[(i + 1) % one.on_a.size()] - from;
      const Point outward = cross(side, one.normal);
      const auto reach = [&](const Polygon& polygon) {
        std::pair<Rational, Rational> range{dot(polygon[0] - from, outward), dot(polygon[0] - from, outward)};
        for (const Point& point : polygon) {
          range.first = std::min(range.first, dot(point - from, outward));
          range.second = std::max(range.second, dot(point - from, outward));
        }
        return range;
      };
      const auto own = reach(one.on_a);
      const auto others = reach(other.on_a);
      if (others.first > own.second || others.second < own.first) return true;
    }
    return false;
  };
  return !separates(p, q) && !separates(q, p);
}

/// Gives pieces that meet, directly or through others, the same group.
void group_meeting(std::vector<Overlap>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].group = i;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (pieces[i].group == pieces[j].group || !meet(pieces[i], pieces[j])) continue;
      const std::size_t from = std::max(pieces[i].group, pieces[j].group);
      const std::size_t to = std::min(pieces[i].group, pieces[j].group);
      for (Overlap& piece : pieces)
        if (piece.group == from) piece.group = to;
    }
  }
}

/// The sum of the areas of one group, squared and in the caller's units (times 4), and its middle.
struct Piece {
  Rational area_squared = 0;
  Point middle, across;
};

Piece joined(const std::vector<Overlap>& pieces, std::size_t group) {
  const Overlap& first = pieces[group];
  Rational total = 0;
  Point sum{0, 0, 0};
  for (const Overlap& piece : pieces) {
    if (piece.group != group) continue;
    total += area(piece.on_a, first.normal);
    sum = sum + weighted_centroid(piece.on_a, first.normal);
  }
  return {total * total / squared_length(first.normal), Rational(1 / total) * sum, first.across};
}

std::optional<ExactContact> face_over_face(const ExactShape& a, std::uint32_t face_a, const ExactShape& b,
                                           std::uint32_t face_b, const Rational& distance_squared) {
  std::vector<Overlap> pieces;
  for (const Triangle& triangle_a : a.faces[face_a].triangles)
    for (const Triangle& triangle_b : b.faces[face_b].triangles)
      if (auto piece = overlap_of(a, triangle_a, b, triangle_b, distance_squared))
        pieces.push_back(std::move(*piece));
  if (pieces.empty()) return std::nullopt;
  group_meeting(pieces);
  Piece largest;
  for (std::size_t group = 0; group < pieces.size(); ++group) {
    if (pieces[group].group != group) continue;
    Piece piece = joined(pieces, group);
    if (piece.area_squared > largest.area_squared) largest = std::move(piece);
  }
  return ExactContact{distance_squared, largest.middle, largest.middle + largest.across, false};
}

void add(ExactContacts& contacts, Feature a, Feature b, std::optional<ExactContact> contact) {
  if (contact) contacts.emplace(name_of(a, b), std::move(*contact));
}

Feature face_feature(std::uint32_t index) {
  return {FeatureKind::face, index};
}

}  // namespace

ExactContacts collect_parallel(const ExactShape& a, const ExactShape& b, const Rational& distance_squared,
                               const FacePairs& pairs) {
  const Limit limit = Limit::up_to(distance_squared);
  ExactContacts contacts;
  for (const Segment& edge_a : a.edges()) {
    for (const Segment& edge_b : b.edges()) {
      if (limit.certainly_excludes(edge_a.extent, edge_b.extent)) continue;
      add(contacts, edge_a.owner, edge_b.owner, parallel_edges(a, edge_a, b, edge_b, distance_squared));
    }
    for (std::uint32_t face = 0; face < b.faces.size(); ++face) {
      if (limit.certainly_excludes(edge_a.extent, b.faces[face].extent)) continue;
      add(contacts, edge_a.owner, face_feature(face), edge_over_face(a, edge_a, b, face, distance_squared));
    }
  }
  for (std::uint32_t face_a = 0; face_a < a.faces.size(); ++face_a) {
    for (const Segment& edge_b : b.edges()) {
      if (limit.certainly_excludes(a.faces[face_a].extent, edge_b.extent)) continue;
      auto contact = edge_over_face(b, edge_b, a, face_a, distance_squared);
      if (contact) std::swap(contact->point_a, contact->point_b);
      add(contacts, face_feature(face_a), edge_b.owner, std::move(contact));
    }
    for (std::uint32_t face_b = 0; face_b < b.faces.size(); ++face_b) {
      if (limit.certainly_excludes(a.faces[face_a].extent, b.faces[face_b].extent)) continue;
      add(contacts, face_feature(face_a), face_feature(face_b),
          face_over_face(a, face_a, b, face_b, distance_squared));
    }
  }
  std::erase_if(contacts, [&](const auto& contact) { return !pairs.may(contact.first.a, contact.first.b); });
  return contacts;
}

}  // namespace graze::oracle
