#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <graze/contact_geometry.hpp>
#include <optional>

#include "core/base/compiler.hpp"
#include "core/base/floating_point_scope.hpp"
#include "response/closest_points.hpp"
#include "response/feature_normals.hpp"
#include "response/feature_piercing.hpp"
#include "response/feature_points.hpp"

namespace graze {
namespace {

// The functions that most calls go through are inlined into both forms of evaluate(). A call of one takes a
// tenth of their time.

/// One side of a contact.
struct PlacedFeature {
  PlacedMesh placed;
  Feature feature;

  [[nodiscard]] bool is(FeatureKind kind) const { return feature.kind == kind; }
  [[nodiscard]] Eigen::Vector3d vertex() const { return placed.point(feature.index); }
  [[nodiscard, gnu::always_inline]] Segment edge() const {
    const auto [start, end] = placed.mesh.edge(feature.index);
    return {placed.point(start), placed.point(end)};
  }
  [[nodiscard]] bool is_quad() const { return placed.mesh.face(feature.index).size() == 4; }
  [[nodiscard]] TrianglePoints triangle(std::size_t which) const {
    return triangle_of(placed, feature.index, which);
  }
  [[nodiscard]] Segment diagonal() const {
    const TrianglePoints first = triangle(0);
    return {first[0], first[2]};
  }
  [[nodiscard]] Eigen::Vector3d normal_at(const Eigen::Vector3d& point) const {
    return graze::normal_at(placed, feature, point);
  }
};

PlacedFeature placed_feature(const Mesh& mesh, const PositionView& positions, const Feature& feature) {
  const PlacedFeature result{{indexed(mesh), positions}, feature};
  check_feature(result.placed, feature, "evaluate");
  return result;
}

ClosestPoints closest(const Eigen::Vector3d& point, const Segment& edge) {
  const SegmentPoint found = closest_on_segment(point, edge);
  return {point, found.point, found.point - point, found.is_interior};
}

ClosestPoints closest_to_face(const Eigen::Vector3d& point, const PlacedFeature& face) {
  TrianglePoint best = closest_on_triangle(point, face.triangle(0));
  bool is_interior = best.part == TrianglePart::inside;
  if (face.is_quad()) {
    const TrianglePoint second = closest_on_triangle(point, face.triangle(1));
    const bool is_on_fold = best.part == TrianglePart::edge_20 && second.part == TrianglePart::edge_01;
    if (second.gap.squaredNorm() < best.gap.squaredNorm()) best = second;
    is_interior = best.part == TrianglePart::inside || is_on_fold;
  }
  return {point, point - best.gap, -best.gap, is_interior, -1, best.height};
}

/// Whether points serve better as the closest ones of two features.
bool is_better(const ClosestPoints& found, const ClosestPoints& best) {
  if (found.are_interior != best.are_interior) return found.are_interior;
  return found.gap.squaredNorm() < best.gap.squaredNorm();
}

/// Where a segment passes through the inside of a face. The point is rounded.
std::optional<ClosestPoints> piercing(const Segment& segment, const PlacedFeature& face) {
  const std::int8_t which = pierced_triangle_of(segment, face.placed, face.feature.index);
  if (which < 0) return std::nullopt;
  const TrianglePoints triangle = face.triangle(static_cast<std::size_t>(which));
  const Eigen::Vector3d normal = area_normal(triangle);
  const double start = normal.dot(segment[0] - triangle[0]);
  const double end = normal.dot(segment[1] - triangle[0]);
  // Near 0 these are what rounding leaves.
  const double way = start == end ? 0.5 : std::clamp(start / (start - end), 0.0, 1.0);
  const Eigen::Vector3d point = segment[0] + (segment[1] - segment[0]) * way;
  return ClosestPoints{point, point, Eigen::Vector3d::Zero(), true, which};
}

/// Points inside both come before nearer ones that are not: first where the segment pierces the face, then
/// where it is closest to the inner diagonal.
ClosestPoints closest_to_face(const Segment& segment, const PlacedFeature& face) {
  if (const auto pierced = piercing(segment, face)) return *pierced;
  ClosestPoints first = closest_of_segment_and_triangle(segment, face.triangle(0));
  if (!face.is_quad()) return first;
  ClosestPoints fold = closest_of_segments(segment, face.diagonal());
  if (fold.are_interior) return fold;
  const ClosestPoints second = closest_of_segment_and_triangle(segment, face.triangle(1));
  return is_better(second, first) ? second : first;
}

/// One of the closest points of two faces is on an edge or on an inner diagonal.
ClosestPoints closest_of_faces(const PlacedFeature& a, const PlacedFeature& b) {
  std::optional<ClosestPoints> best;
  const auto offer_segments = [&](const PlacedFeature& of, const PlacedFeature& to, bool is_swapped) {
    const auto offer = [&](const Segment& segment, bool is_inside) {
      ClosestPoints found = closest_to_face(segment, to);
      found.are_interior = found.are_interior && is_inside;
      found.pierced_triangle = -1;
      if (!best || is_better(found, *best)) best = is_swapped ? found.swapped() : found;
    };
    if (of.is_quad()) offer(of.diagonal(), true);
    for (std::size_t which = 0; which < (of.is_quad() ? 2U : 1U); ++which) {
      const TrianglePoints triangle = of.triangle(which);
      for (std::size_t i = 0; i < 3; ++i) offer({triangle[i], triangle[(i + 1) % 3]}, false);
    }
  };
  offer_segments(a, b, false);
  offer_segments(b, a, true);
  return *best;
}

/// The feature of lower dimension is a's.
GRAZE_ALWAYS_INLINE inline ClosestPoints closest_in_order(const PlacedFeature& a, const PlacedFeature& b) {
  if (a.is(FeatureKind::face)) return closest_of_faces(a, b);
  if (a.is(FeatureKind::edge))
    return b.is(FeatureKind::edge) ? closest_of_segments(a.edge(), b.edge()) : closest_to_face(a.edge(), b);
  if (b.is(FeatureKind::face)) return closest_to_face(a.vertex(), b);
  if (b.is(FeatureKind::edge)) return closest(a.vertex(), b.edge());
  return {a.vertex(), b.vertex(), b.vertex() - a.vertex(), true};
}

GRAZE_ALWAYS_INLINE inline ClosestPoints closest_points(const PlacedFeature& a, const PlacedFeature& b) {
  return a.feature.kind <= b.feature.kind ? closest_in_order(a, b) : closest_in_order(b, a).swapped();
}

/// Whether a sum of unit normals is one that says something.
bool exists(const Eigen::Vector3d& normal) {
  return normal.norm() > 0x1p-40;
}

/// The rule of Contact::normal for distance 0, in plain double.
Eigen::Vector3d touching_normal(const PlacedFeature& a, const PlacedFeature& b, const ClosestPoints& at) {
  const auto normal_of = [&](const PlacedFeature& of, const Eigen::Vector3d& point) {
    const bool is_pierced = of.is(FeatureKind::face) && at.pierced_triangle >= 0;
    return is_pierced ? unit_normal(of.triangle(static_cast<std::size_t>(at.pierced_triangle)))
                      : of.normal_at(point);
  };
  const Eigen::Vector3d of_a = normal_of(a, at.a);
  const Eigen::Vector3d of_b = normal_of(b, at.b);
  if (a.is(FeatureKind::face) && exists(of_a)) return of_a.normalized();
  if (b.is(FeatureKind::face) && exists(of_b)) return -of_b.normalized();
  if (a.is(FeatureKind::edge) && b.is(FeatureKind::edge)) {
    const Eigen::Vector3d across = (a.edge()[1] - a.edge()[0]).cross(b.edge()[1] - b.edge()[0]);
    if (across.squaredNorm() > 0) {
      Eigen::Vector3d ends = Eigen::Vector3d::Zero();
      for (const std::uint32_t vertex : a.placed.mesh.edge(a.feature.index))
        ends += normal_at(a.placed, {FeatureKind::vertex, vertex}, at.a);
      return across.dot(ends) < 0 ? Eigen::Vector3d(-across.normalized())
                                  : Eigen::Vector3d(across.normalized());
    }
  }
  if (exists(of_a)) return of_a.normalized();
  if (exists(of_b)) return -of_b.normalized();
  return Eigen::Vector3d::UnitZ();
}

/// The part of the geometry that needs no sign. The push, the separation and the sides follow.
GRAZE_ALWAYS_INLINE inline ContactGeometry unsigned_geometry(const PlacedFeature& a, const PlacedFeature& b,
                                                             const ClosestPoints& at) {
  ContactGeometry geometry;
  geometry.point_a = at.a;
  geometry.point_b = at.b;
  geometry.distance = at.gap.norm();
  geometry.normal =
      geometry.distance == 0 ? touching_normal(a, b, at) : Eigen::Vector3d(at.gap / geometry.distance);
  geometry.is_interior = at.are_interior && !std::isnan(geometry.distance);
  return geometry;
}

bool are_edges(const PlacedFeature& a, const PlacedFeature& b) {
  return a.is(FeatureKind::edge) && b.is(FeatureKind::edge);
}

/// Whether the separation is negative, as Contact::separation() says.
bool is_behind(const PlacedFeature& a, const PlacedFeature& b, Side side_a, Side side_b) {
  const auto is_behind_a = [&] { return side_a == Side::back; };
  const auto is_behind_b = [&] { return side_b == Side::back; };
  const auto is_sunk = [&] {
    return is_behind_a() && is_behind_b() &&
           (pierces_any_face(a.edge(), b.placed) || pierces_any_face(b.edge(), a.placed));
  };
  return has_negative_separation(a.feature.kind, b.feature.kind, is_behind_a, is_behind_b, is_sunk);
}

/// The side of one of both to which `gap` leads from `point`.
Side side_of(const PlacedFeature& of, const ClosestPoints& at, const Eigen::Vector3d& point,
             const Eigen::Vector3d& gap) {
  if (of.is(FeatureKind::face) && at.height != 0) return at.height < 0 ? Side::back : Side::front;
  return side_along(of.placed, of.feature, point, gap);
}

ContactGeometry geometry_by_sides(const PlacedFeature& a, const PlacedFeature& b) {
  const ClosestPoints at = closest_points(a, b);
  ContactGeometry geometry = unsigned_geometry(a, b, at);
  geometry.push = geometry.normal;
  if (geometry.distance == 0) return geometry;
  geometry.separation = geometry.distance;
  geometry.side_a = side_of(a, at, at.a, at.gap);
  geometry.side_b = side_of(b, at, at.b, -at.gap);
  if (!is_behind(a, b, geometry.side_a, geometry.side_b)) return geometry;
  geometry.push = -geometry.normal;
  geometry.separation = -geometry.distance;
  geometry.sunk = are_edges(a, b);
  return geometry;
}

/// The direction across both features, also where they are closest at a border: the cross product of edges,
/// or the normal of the only face. No value where there is none.
std::optional<Eigen::Vector3d> direction_across(const PlacedFeature& a, const PlacedFeature& b,
                                                const ClosestPoints& at) {
  if (are_edges(a, b)) {
    const auto along = [](const Segment& edge) { return Eigen::Vector3d(edge[1] - edge[0]); };
    const Eigen::Vector3d along_a = along(a.edge());
    const Eigen::Vector3d along_b = along(b.edge());
    const Eigen::Vector3d across = along_a.cross(along_b);
    if (are_parallel(along_a, along_b, across.squaredNorm())) return std::nullopt;
    return across.normalized();
  }
  if (a.is(FeatureKind::face) == b.is(FeatureKind::face)) return std::nullopt;
  const Eigen::Vector3d normal = a.is(FeatureKind::face) ? a.normal_at(at.a) : b.normal_at(at.b);
  return exists(normal) ? std::optional<Eigen::Vector3d>(normal.normalized()) : std::nullopt;
}

Side turned(Side side) {
  if (side == Side::none) return side;
  return side == Side::front ? Side::back : Side::front;
}

/// The features have the contact's sign, as long as their direction does not turn by more than 90 degrees.
ContactGeometry continued_geometry(const PlacedFeature& a, const PlacedFeature& b, const Contact& contact) {
  const ClosestPoints at = closest_points(a, b);
  ContactGeometry geometry = unsigned_geometry(a, b, at);
  const auto across = geometry.is_interior ? std::nullopt : direction_across(a, b, at);
  const Eigen::Vector3d direction = across.value_or(geometry.normal);
  const bool is_against = direction.dot(contact.push()) < 0;
  geometry.push = is_against ? Eigen::Vector3d(-direction) : direction;
  if (geometry.distance == 0) return geometry;
  geometry.separation = is_against ? -geometry.distance : geometry.distance;
  if (across) geometry.separation = at.gap.dot(geometry.push);
  const bool has_passed = (geometry.separation < 0) != (contact.separation() < 0);
  geometry.side_a = has_passed ? turned(contact.side_a) : contact.side_a;
  geometry.side_b = has_passed ? turned(contact.side_b) : contact.side_b;
  geometry.sunk = are_edges(a, b) && geometry.separation < 0;
  return geometry;
}

}  // namespace

ContactGeometry evaluate(const Mesh& mesh_a, PositionView positions_a, const Feature& feature_a,
                         const Mesh& mesh_b, PositionView positions_b, const Feature& feature_b) {
  const PlacedFeature a = placed_feature(mesh_a, positions_a, feature_a);
  const PlacedFeature b = placed_feature(mesh_b, positions_b, feature_b);
  const BriefFloatingPointScope scope;
  return geometry_by_sides(a, b);
}

ContactGeometry evaluate(const Mesh& mesh_a, PositionView positions_a, const Mesh& mesh_b,
                         PositionView positions_b, const Contact& contact) {
  const PlacedFeature a = placed_feature(mesh_a, positions_a, contact.feature_a);
  const PlacedFeature b = placed_feature(mesh_b, positions_b, contact.feature_b);
  const BriefFloatingPointScope scope;
  return continued_geometry(a, b, contact);
}

}  // namespace graze
