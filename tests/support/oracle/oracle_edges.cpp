#include "support/oracle/oracle_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace graze::oracle {

namespace {

bool has(const std::array<std::uint32_t, 3>& corners, std::uint32_t vertex) {
  return std::find(corners.begin(), corners.end(), vertex) != corners.end();
}

/// The corner of a triangle that is not an end of an edge, if the two others are its ends.
std::optional<std::uint32_t> corner_beside(const Triangle& triangle, const Segment& edge) {
  if (!has(triangle.corners, edge.ends[0]) || !has(triangle.corners, edge.ends[1])) return std::nullopt;
  for (const std::uint32_t corner : triangle.corners)
    if (corner != edge.ends[0] && corner != edge.ends[1]) return corner;
  return std::nullopt;
}

/// The normal of the triangle of a face that has an edge. Zero where none has.
Point normal_beside(const std::vector<Beside>& beside, std::uint32_t face) {
  const auto found = std::find_if(beside.begin(), beside.end(),
                                  [face](const Beside& candidate) { return candidate.face == face; });
  return found == beside.end() ? Point{} : found->triangle->normal;
}

bool is_bent(const Point& n, const Point& m) {
  const Rational product = dot(n, m);
  return product < 0 || product * product < Rational(127, 128) * squared_length(n) * squared_length(m);
}

/// The direction from the point of one edge to that of another, not of unit length. It is square to both
/// edges, and zero where they cross.
Point direction_between(const ExactShape& a, const Segment& edge_a, const ExactShape& b,
                        const Segment& edge_b) {
  const Point& p = a.points[edge_a.ends[0]];
  const Point& q = b.points[edge_b.ends[0]];
  const Point across = cross(a.points[edge_a.ends[1]] - p, b.points[edge_b.ends[1]] - q);
  return Rational(sgn(dot(q - p, across))) * across;
}

/// The side of a surface to which a direction leads from one of its edges, by the sum of the unit normals
/// beside the edge.
Side side_of(const std::vector<Beside>& beside, const Point& direction) {
  long double sum = 0;
  for (const Beside& triangle : beside) {
    const Point& normal = triangle.triangle->normal;
    if (is_zero(normal) || is_zero(direction)) continue;
    const Rational height = dot(normal, direction);
    const Rational cosine_squared = height * height / (squared_length(normal) * squared_length(direction));
    sum += sgn(height) * static_cast<long double>(round_sqrt(cosine_squared));
  }
  if (!(std::abs(sum) * std::numbers::pi > 0x1p-36)) return Side::none;
  return sum > 0 ? Side::front : Side::back;
}

/// How far a triangle beside an edge rises along a direction square to the edge, times some length. Above 0,
/// a way from the edge into the triangle, square to the edge, leads along the direction.
Rational height_of(const ExactShape& shape, const Segment& edge, const Beside& beside,
                   const Point& direction) {
  return dot(shape.points[beside.corner] - shape.points[edge.ends[0]], direction);
}

/// Whether a direction, square to an edge, leads away from a triangle beside the edge, or rises over its
/// plane by no more than the angle whose sine is the root of 1/32.
bool is_near_cone(const ExactShape& shape, const Segment& edge, const Beside& beside,
                  const Point& direction) {
  const Point& p = shape.points[edge.ends[0]];
  const Point along = shape.points[edge.ends[1]] - p;
  const Point across = shape.points[beside.corner] - p;
  const Rational height = height_of(shape, edge, beside, direction);
  if (height <= 0) return true;
  const Rational width_squared =
      squared_length(across) * squared_length(along) - dot(across, along) * dot(across, along);
  return height * height * squared_length(along) * 32 <= squared_length(direction) * width_squared;
}

/// Whether the triangles beside an edge lie on both sides of it, with an area, all square to a direction.
bool is_within_level(const ExactShape& shape, const Segment& edge, const std::vector<Beside>& beside,
                     const Point& direction) {
  const Point& p = shape.points[edge.ends[0]];
  const Point across = cross(direction, shape.points[edge.ends[1]] - p);
  bool is_before = false;
  bool is_behind = false;
  for (const Beside& triangle : beside) {
    const int side = sgn(dot(shape.points[triangle.corner] - p, across));
    if (side == 0 || height_of(shape, edge, triangle, direction) != 0) return false;
    (side < 0 ? is_before : is_behind) = true;
  }
  return is_before && is_behind;
}

/// Which edges pierce a face of the other shape that they may be looked at with.
template <typename May>
std::vector<bool> piercing_edges(const ExactShape& shape, const ExactShape& other, const May& may) {
  std::vector<bool> pierces;
  for (const Segment& edge : shape.edges()) {
    bool is_found = false;
    for (std::uint32_t face = 0; face < other.faces.size() && !is_found; ++face)
      is_found = gap_squared(edge.extent, other.faces[face].extent) == 0 &&
                 may(edge.owner, Feature{FeatureKind::face, face}) && crossing(shape, edge, other, face);
    pierces.push_back(is_found);
  }
  return pierces;
}

}  // namespace

EdgeSurroundings::EdgeSurroundings(const ExactShape& shape)
    : beside_(shape.edge_count), faces_(shape.edge_count) {
  for (std::uint32_t index = 0; index < shape.faces.size(); ++index) {
    for (const std::uint32_t edge : shape.faces[index].edges) {
      faces_[edge].push_back(index);
      for (const Triangle& triangle : shape.faces[index].triangles)
        if (const auto corner = corner_beside(triangle, shape.segments[edge]))
          beside_[edge].push_back({index, *corner, &triangle});
    }
  }
}

std::vector<bool> creases_of(const Shape& rest) {
  const ExactShape shape(rest);
  const EdgeSurroundings around(shape);
  std::vector<bool> creases;
  for (std::uint32_t edge = 0; edge < shape.edge_count; ++edge) {
    const auto& faces = around.faces(edge);
    const auto& beside = around.beside(edge);
    creases.push_back(faces.size() != 2 ||
                      is_bent(normal_beside(beside, faces[0]), normal_beside(beside, faces[1])));
  }
  return creases;
}

EdgeOracle::EdgeOracle(const ExactShape& a, const ExactShape& b, const FacePairs& pairs)
    : a_(a), b_(b), pairs_(pairs) {
  a_.pierces = piercing_edges(
      a, b, [&](const Feature& edge, const Feature& face) { return pairs.may_pierce(edge, face); });
  b_.pierces = piercing_edges(
      b, a, [&](const Feature& edge, const Feature& face) { return pairs.may_pierce(face, edge); });
}

std::vector<EdgePair> EdgeOracle::pairs_within(const Limit& limit, const Creases& creases) const {
  std::vector<EdgePair> found;
  for (const Segment& edge_a : a_.shape.edges())
    for (const Segment& edge_b : b_.shape.edges()) {
      if (limit.certainly_excludes(edge_a.extent, edge_b.extent)) continue;
      if (!pairs_.may(edge_a.owner, edge_b.owner)) continue;
      auto contact = inner_contact(a_.shape, edge_a, b_.shape, edge_b);
      if (!contact || !limit.admits(contact->a.distance_squared)) continue;
      found.push_back(judged(edge_a, edge_b, std::move(*contact), creases));
    }
  return found;
}

bool EdgeOracle::are_sunk(const Feature& edge_a, const Feature& edge_b) const {
  if (!a_.pierces[edge_a.index] && !b_.pierces[edge_b.index]) return false;
  const Point direction =
      direction_between(a_.shape, a_.shape.segments[edge_a.index], b_.shape, b_.shape.segments[edge_b.index]);
  return side_of(a_.around.beside(edge_a.index), direction) == Side::back &&
         side_of(b_.around.beside(edge_b.index), Rational(-1) * direction) == Side::back;
}

EdgePair EdgeOracle::judged(const Segment& edge_a, const Segment& edge_b, SegmentContact contact,
                            const Creases& creases) const {
  EdgePair pair{edge_a.owner, edge_b.owner, std::move(contact)};
  const auto& beside_a = a_.around.beside(pair.a.index);
  const auto& beside_b = b_.around.beside(pair.b.index);
  const Point direction = direction_between(a_.shape, edge_a, b_.shape, edge_b);
  const Point opposite = Rational(-1) * direction;
  pair.side_a = side_of(beside_a, direction);
  pair.side_b = side_of(beside_b, opposite);
  pair.is_sunk = are_sunk(pair.a, pair.b);

  const auto is_seen_beside_a = [&](const Beside& beside) {
    return pairs_.may_lead({FeatureKind::face, beside.face}, pair.b);
  };
  const auto is_seen_beside_b = [&](const Beside& beside) {
    return pairs_.may_lead(pair.a, {FeatureKind::face, beside.face});
  };
  // Whether a rule holds for all triangles that are looked at, with the direction away from each edge.
  const auto holds = [&](const auto& rule, const Point& from_a, const Point& from_b) {
    const auto of_a = [&](const Beside& beside) {
      return !is_seen_beside_a(beside) || rule(a_.shape, edge_a, beside, from_a);
    };
    const auto of_b = [&](const Beside& beside) {
      return !is_seen_beside_b(beside) || rule(b_.shape, edge_b, beside, from_b);
    };
    return std::all_of(beside_a.begin(), beside_a.end(), of_a) &&
           std::all_of(beside_b.begin(), beside_b.end(), of_b);
  };
  const auto leads_no_nearer = [](const auto&... arguments) { return height_of(arguments...) <= 0; };
  const auto is_near = [](const auto&... arguments) { return is_near_cone(arguments...); };
  pair.is_locally_closest = holds(leads_no_nearer, direction, opposite);
  if (is_zero(direction)) return pair;

  const bool is_crease_a = creases.a[pair.a.index];
  const bool is_crease_b = creases.b[pair.b.index];
  pair.lies_flat = (!is_crease_a && is_within_level(a_.shape, edge_a, beside_a, direction) &&
                    std::all_of(beside_a.begin(), beside_a.end(), is_seen_beside_a)) ||
                   (!is_crease_b && is_within_level(b_.shape, edge_b, beside_b, direction) &&
                    std::all_of(beside_b.begin(), beside_b.end(), is_seen_beside_b));
  pair.bounds_patch =
      is_crease_a && is_crease_b &&
      (pair.is_sunk ? holds(is_near, opposite, direction) : holds(is_near, direction, opposite));
  return pair;
}

}  // namespace graze::oracle
