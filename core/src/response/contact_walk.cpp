#include <Eigen/Geometry>
#include <graze/contact_walk.hpp>
#include <optional>

#include "core/base/floating_point_scope.hpp"
#include "response/edge_walk.hpp"
#include "response/feature_normals.hpp"
#include "response/feature_piercing.hpp"
#include "response/feature_points.hpp"
#include "response/surface_walk.hpp"

namespace graze {
namespace {

/// A contact and the two surfaces at their positions now.
struct ContactNow {
  const Mesh& mesh_a;
  const Mesh& mesh_b;
  PlacedMesh a;
  PlacedMesh b;
  const Contact& contact;

  [[nodiscard]] bool has(FeatureKind kind_a, FeatureKind kind_b) const {
    return contact.feature_a.kind == kind_a && contact.feature_b.kind == kind_b;
  }
};

Side turned_side(Side side) {
  if (side == Side::none) return side;
  return side == Side::front ? Side::back : Side::front;
}

/// The answer that stays with the features of the report.
FollowedContact unmoved(const ContactNow& now, bool is_known) {
  return {now.contact.feature_a, now.contact.feature_b,
          evaluate(now.mesh_a, now.a.positions, now.mesh_b, now.b.positions, now.contact), is_known, 0};
}

/// Whether the separation is negative, and whether it was in the report.
struct Sign {
  bool is_behind = false;
  bool was_behind = false;

  [[nodiscard]] bool has_changed() const { return is_behind != was_behind; }
};

/// An answer at a distance above 0. `gap` leads from a to b.
FollowedContact moved(const ContactNow& now, const WalkedPoint& on_a, const WalkedPoint& on_b,
                      const Eigen::Vector3d& gap, const Sign& sign, unsigned steps) {
  FollowedContact found{on_a.feature, on_b.feature, {}, true, steps};
  ContactGeometry& geometry = found.geometry;
  geometry.point_a = on_a.point;
  geometry.point_b = on_b.point;
  geometry.distance = gap.norm();
  geometry.normal = gap / geometry.distance;
  geometry.push = sign.is_behind ? Eigen::Vector3d(-geometry.normal) : geometry.normal;
  geometry.separation = sign.is_behind ? -geometry.distance : geometry.distance;
  const bool has_passed = sign.has_changed();
  geometry.side_a = has_passed ? turned_side(now.contact.side_a) : now.contact.side_a;
  geometry.side_b = has_passed ? turned_side(now.contact.side_b) : now.contact.side_b;
  geometry.is_interior = true;
  return found;
}

/// A contact whose vertex is kept, seen from the vertex.
struct KeptVertex {
  const PlacedMesh& of;
  std::uint32_t vertex;
  const PlacedMesh& surface;
  Feature start;
  bool is_of_a;
  bool was_behind;
  Eigen::Vector3d push;  ///< on the vertex, in the report
};

KeptVertex kept_vertex(const ContactNow& now, bool is_of_a) {
  const Contact& contact = now.contact;
  KeptVertex kept{is_of_a ? now.a : now.b,
                  is_of_a ? contact.feature_a.index : contact.feature_b.index,
                  is_of_a ? now.b : now.a,
                  is_of_a ? contact.feature_b : contact.feature_a,
                  is_of_a,
                  contact.separation() < 0,
                  is_of_a ? Eigen::Vector3d(-contact.push()) : contact.push()};
  if (now.has(FeatureKind::vertex, FeatureKind::vertex) && contact.distance > 0) {
    // The other vertex may be behind the surface of this one, and this one outside.
    const bool is_behind = (is_of_a ? contact.side_b : contact.side_a) == Side::back;
    if (is_behind != kept.was_behind) kept.push = -kept.push;
    kept.was_behind = is_behind;
  }
  return kept;
}

/// Finds whether the vertex is behind the surface now, with the report's sign continued. Gives no value where
/// that is not known.
std::optional<Sign> sign_now(const KeptVertex& kept, const SurfaceWalk& walk) {
  const WalkedPoint& end = walk.end;
  if (walk.steps == 0) {
    const double along = end.gap.dot(kept.push);
    const Sign sign{along < 0, kept.was_behind};
    // The vertex may have gone around a border.
    if (sign.has_changed() && is_at_border(kept.surface, end)) return std::nullopt;
    return sign;
  }
  const WalkedPoint start = closest_on_feature(kept.surface, kept.start, end.point + end.gap);
  const Side front = side_along(kept.surface, kept.start, start.point, kept.push);
  const Side side = side_along(kept.surface, end.feature, end.point, end.gap);
  if (front == Side::none || side == Side::none) return std::nullopt;
  const Sign sign{front != side, kept.was_behind};
  // Two vertices may be closest for the other one alone. Then the report's side says nothing of this one.
  // From behind a surface, parts that are further away are locally closest, too.
  const bool may_be_of_other = kept.start.kind == FeatureKind::vertex;
  if (may_be_of_other && (front == Side::back || sign.is_behind)) return std::nullopt;
  const bool met_border = walk.met_border || is_at_border(kept.surface, start);
  return sign.has_changed() && met_border ? std::nullopt : std::optional(sign);
}

/// The answer at distance 0: that of evaluate() for the features at the end, with the push continued.
FollowedContact touching(const ContactNow& now, const KeptVertex& kept, const SurfaceWalk& walk) {
  const bool is_of_self = &now.a.mesh == &now.b.mesh && now.a.positions.data() == now.b.positions.data();
  if (is_of_self && walk.end.feature == Feature{FeatureKind::vertex, kept.vertex}) return unmoved(now, false);
  Contact contact = now.contact;
  (kept.is_of_a ? contact.feature_b : contact.feature_a) = walk.end.feature;
  return {contact.feature_a, contact.feature_b,
          evaluate(now.mesh_a, now.a.positions, now.mesh_b, now.b.positions, contact), true, walk.steps};
}

FollowedContact follow_vertex(const ContactNow& now, bool is_of_a) {
  const KeptVertex kept = kept_vertex(now, is_of_a);
  const Eigen::Vector3d point = kept.of.point(kept.vertex);
  const SurfaceWalk walk = walk_to_closest(kept.surface, kept.start, point);
  if (!walk.has_arrived) return unmoved(now, false);
  if (walk.end.squared == 0) return touching(now, kept, walk);
  if (!(walk.end.squared > 0)) return unmoved(now, false);
  const auto sign = sign_now(kept, walk);
  if (!sign) return unmoved(now, false);
  WalkedPoint vertex;
  vertex.point = point;
  vertex.feature = {FeatureKind::vertex, kept.vertex};
  return is_of_a ? moved(now, vertex, walk.end, -walk.end.gap, *sign, walk.steps)
                 : moved(now, walk.end, vertex, walk.end.gap, *sign, walk.steps);
}

FollowedContact follow_edges(const ContactNow& now) {
  const std::uint32_t edge_a = now.contact.feature_a.index;
  const std::uint32_t edge_b = now.contact.feature_b.index;
  FollowedContact stays = unmoved(now, false);
  const auto segment = [](const PlacedMesh& placed, std::uint32_t edge) {
    const auto ends = placed.mesh.edge(edge);
    return Segment{placed.point(ends[0]), placed.point(ends[1])};
  };
  const ClosestPoints at = closest_of_segments(segment(now.a, edge_a), segment(now.b, edge_b));
  const double separation = stays.geometry.separation;
  if (stays.geometry.is_interior) {
    stays.is_known = stays.geometry.distance == 0 ||
                     (separation > 0 && are_locally_closest(now.a, edge_a, now.b, edge_b, at)) ||
                     bound_patch(now.a, edge_a, now.b, edge_b, at, separation < 0);
    if (stays.is_known) return stays;
  }
  if (!(separation > 0)) return stays;
  const PairWalk walk = walk_together(now.a, edge_a, now.b, edge_b, at);
  // A report lists the fold of a quad only where there is nothing else.
  const auto is_face = [](const WalkedPoint& on) { return on.feature.kind == FeatureKind::face; };
  const auto is_vertex = [](const WalkedPoint& on) { return on.feature.kind == FeatureKind::vertex; };
  const bool is_at_fold = (is_face(walk.a) && !is_vertex(walk.b)) || (is_face(walk.b) && !is_vertex(walk.a));
  if (!walk.has_arrived || is_at_fold) return stays;
  return moved(now, walk.a, walk.b, walk.a.gap, {false, now.contact.separation() < 0}, walk.steps);
}

/// Moves an edge that pierced a face to a face around it.
FollowedContact follow_piercing(const ContactNow& now, bool is_face_of_a) {
  const PlacedMesh& placed = is_face_of_a ? now.a : now.b;
  const PlacedMesh& other = is_face_of_a ? now.b : now.a;
  const Feature& face = is_face_of_a ? now.contact.feature_a : now.contact.feature_b;
  const Feature& edge = is_face_of_a ? now.contact.feature_b : now.contact.feature_a;
  const auto ends = other.mesh.edge(edge.index);
  const Segment segment{other.point(ends[0]), other.point(ends[1])};
  if (pierced_triangle_of(segment, placed, face.index) >= 0) return unmoved(now, true);
  for (const std::uint32_t vertex : placed.mesh.face(face.index))
    for (const std::uint32_t around : placed.mesh.vertex_faces(vertex)) {
      if (around == face.index || pierced_triangle_of(segment, placed, around) < 0) continue;
      Contact contact = now.contact;
      (is_face_of_a ? contact.feature_a : contact.feature_b).index = around;
      FollowedContact found = unmoved({now.mesh_a, now.mesh_b, now.a, now.b, contact}, true);
      found.steps = 1;
      return found;
    }
  return unmoved(now, false);
}

FollowedContact follow_contact(const Mesh& mesh_a, const PositionView& positions_a, const Mesh& mesh_b,
                               const PositionView& positions_b, const Contact& contact, bool prefers_a) {
  const ContactNow now{
      mesh_a, mesh_b, {indexed(mesh_a), positions_a}, {indexed(mesh_b), positions_b}, contact};
  check_feature(now.a, contact.feature_a, "follow");
  check_feature(now.b, contact.feature_b, "follow");
  const BriefFloatingPointScope scope;
  const bool has_vertex_a = contact.feature_a.kind == FeatureKind::vertex;
  const bool has_vertex_b = contact.feature_b.kind == FeatureKind::vertex;
  if (has_vertex_a || has_vertex_b) return follow_vertex(now, has_vertex_a && (prefers_a || !has_vertex_b));
  if (now.has(FeatureKind::edge, FeatureKind::edge)) return follow_edges(now);
  if (contact.distance == 0 && now.has(FeatureKind::face, FeatureKind::edge))
    return follow_piercing(now, true);
  if (contact.distance == 0 && now.has(FeatureKind::edge, FeatureKind::face))
    return follow_piercing(now, false);
  return unmoved(now, false);
}

}  // namespace

FollowedContact follow(const Mesh& mesh_a, PositionView positions_a, const Mesh& mesh_b,
                       PositionView positions_b, const Contact& contact) {
  return follow_contact(mesh_a, positions_a, mesh_b, positions_b, contact, true);
}

FollowedContact follow_vertex_of_b(const Mesh& mesh_a, PositionView positions_a, const Mesh& mesh_b,
                                   PositionView positions_b, const Contact& contact) {
  return follow_contact(mesh_a, positions_a, mesh_b, positions_b, contact, false);
}

}  // namespace graze
