#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <graze/contact_geometry.hpp>
#include <optional>
#include <span>

#include "closest_features/piercing.hpp"
#include "core/base/floating_point_scope.hpp"
#include "core/surface/surface.hpp"
#include "response/closest_points.hpp"
#include "response/feature_normals.hpp"
#include "response/feature_points.hpp"

namespace graze {
namespace {

/// One side of a contact.
struct PlacedFeature {
  PlacedMesh placed;
  Feature feature;

  [[nodiscard]] bool is(FeatureKind kind) const { return feature.kind == kind; }
  [[nodiscard]] Eigen::Vector3d vertex() const { return placed.point(feature.index); }
  [[nodiscard]] Segment edge() const {
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

/// The triangle of a face that a segment passes through, or -1, decided exactly as in reports. It asks plain
/// double first. Coordinates that no report has are not decided.
std::int8_t pierced_triangle_of(const Segment& segment, const PlacedFeature& face) {
  const FloatingPointScope scope;
  std::array<Simplex, 2> triangles{Simplex{3, {}, face.triangle(0)}};
  if (face.is_quad()) triangles[1] = {3, {}, face.triangle(1)};
  const auto some = std::span(triangles).first(face.is_quad() ? 2 : 1);
  std::int8_t passed = -1;
  bool is_sure = true;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const Passing passing = certain_passing(segment, some[i].point);
    is_sure = is_sure && passing != Passing::unsure && (passing == Passing::no || passed < 0);
    if (passing == Passing::yes) passed = static_cast<std::int8_t>(i);
  }
  if (is_sure) return passed;
  const auto is_good = [](const Eigen::Vector3d& point) { return Surface::is_within_limits(point); };
  if (!std::all_of(segment.begin(), segment.end(), is_good)) return -1;
  for (const Simplex& triangle : some)
    if (!std::all_of(triangle.point.begin(), triangle.point.end(), is_good)) return -1;
  DecisionCount count;
  const bool has_fold =
      face.is_quad() && diagonal_of(face.placed.mesh, face.feature.index).feature.kind == FeatureKind::face;
  const auto pierced = pierced_triangle({2, {}, {segment[0], segment[1]}}, some, has_fold, count);
  if (!pierced) return -1;
  return *pierced == Piece::first ? 0 : 1;
}

/// Where a segment passes through the inside of a face. The point is rounded.
std::optional<ClosestPoints> piercing(const Segment& segment, const PlacedFeature& face) {
  const std::int8_t which = pierced_triangle_of(segment, face);
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
ClosestPoints closest_in_order(const PlacedFeature& a, const PlacedFeature& b) {
  if (a.is(FeatureKind::face)) return closest_of_faces(a, b);
  if (a.is(FeatureKind::edge))
    return b.is(FeatureKind::edge) ? closest_of_segments(a.edge(), b.edge()) : closest_to_face(a.edge(), b);
  if (b.is(FeatureKind::face)) return closest_to_face(a.vertex(), b);
  if (b.is(FeatureKind::edge)) return closest(a.vertex(), b.edge());
  return {a.vertex(), b.vertex(), b.vertex() - a.vertex(), true};
}

/// The rule of Contact::normal for distance 0, in plain double.
Eigen::Vector3d touching_normal(const PlacedFeature& a, const PlacedFeature& b, const ClosestPoints& at) {
  const auto exists = [](const Eigen::Vector3d& normal) { return normal.norm() > 0x1p-40; };
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

/// Whether the contact's separation is negative; see Contact::separation().
bool is_behind(const PlacedFeature& a, const PlacedFeature& b, const ClosestPoints& at) {
  if (at.height != 0) return at.height < 0;
  return has_negative_separation(
      a.feature.kind, b.feature.kind,
      [&] { return sign_along_normal(a.placed, a.feature, at.a, at.gap) < 0; },
      [&] { return sign_along_normal(b.placed, b.feature, at.b, at.gap) > 0; });
}

}  // namespace

ContactGeometry evaluate(const Mesh& mesh_a, PositionView positions_a, const Feature& feature_a,
                         const Mesh& mesh_b, PositionView positions_b, const Feature& feature_b) {
  const PlacedFeature a{{indexed(mesh_a), positions_a}, feature_a};
  const PlacedFeature b{{indexed(mesh_b), positions_b}, feature_b};
  check_feature(a.placed, feature_a, "evaluate");
  check_feature(b.placed, feature_b, "evaluate");
  const ClosestPoints at =
      feature_a.kind <= feature_b.kind ? closest_in_order(a, b) : closest_in_order(b, a).swapped();
  ContactGeometry geometry{at.a, at.b, {}, at.gap.norm(), 0, at.are_interior};
  if (geometry.distance == 0) {
    geometry.normal = touching_normal(a, b, at);
  } else {
    geometry.normal = at.gap / geometry.distance;
    geometry.separation = is_behind(a, b, at) ? -geometry.distance : geometry.distance;
    geometry.is_interior = at.are_interior && !std::isnan(geometry.distance);
  }
  return geometry;
}

}  // namespace graze
