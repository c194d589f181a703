#include "response/surface_walk.hpp"

#include <algorithm>

#include "response/closest_points.hpp"

namespace graze {
namespace {

WalkedPoint at_vertex(const PlacedMesh& placed, std::uint32_t vertex, const Eigen::Vector3d& to) {
  WalkedPoint found;
  found.point = placed.point(vertex);
  found.gap = to - found.point;
  found.squared = found.gap.squaredNorm();
  found.feature = {FeatureKind::vertex, vertex};
  found.vertices[0] = vertex;
  found.vertex_count = 1;
  return found;
}

WalkedPoint closest_on_edge(const PlacedMesh& placed, std::uint32_t edge, const Eigen::Vector3d& to) {
  const std::array<std::uint32_t, 2> ends = placed.mesh.edge(edge);
  const SegmentPoint on = closest_on_segment(to, {placed.point(ends[0]), placed.point(ends[1])});
  if (!on.is_interior) return at_vertex(placed, on.parameter > 0 ? ends[1] : ends[0], to);
  WalkedPoint found;
  found.point = on.point;
  found.gap = to - on.point;
  found.squared = found.gap.squaredNorm();
  found.feature = {FeatureKind::edge, edge};
  found.vertices = {ends[0], ends[1], 0};
  found.vertex_count = 2;
  return found;
}

/// The edge of a side of a triangle of a face. It is Mesh::no_edge for an inner diagonal, or where both ends
/// are one vertex.
std::uint32_t edge_of_side(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle,
                           std::size_t side) {
  const auto edges = placed.mesh.face_edges(face);
  if (edges.size() == 3) return edges[side];
  constexpr std::array<std::array<std::int8_t, 3>, 2> side_of_quad{{{0, 1, -1}, {-1, 2, 3}}};
  const std::int8_t which = side_of_quad[triangle][side];
  return which < 0 ? Mesh::no_edge : edges[static_cast<std::size_t>(which)];
}

std::array<std::uint32_t, 3> corners_of(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle) {
  const auto corners = placed.mesh.face(face);
  const auto& [i, j, k] = triangle_corners[triangle];
  return {corners[i], corners[j], corners[k]};
}

WalkedPoint named(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle,
                  const TrianglePoints& points, const TrianglePoint& on, const Eigen::Vector3d& to) {
  switch (on.part) {
    case TrianglePart::corner:
      for (std::size_t i = 0; i < 2; ++i)
        if (to - points[i] == on.gap) return point_at_corner(placed, face, triangle, i, to);
      return point_at_corner(placed, face, triangle, 2, to);
    case TrianglePart::edge_01:
      return point_on_side(placed, face, triangle, 0, to - on.gap, on.gap);
    case TrianglePart::edge_12:
      return point_on_side(placed, face, triangle, 1, to - on.gap, on.gap);
    case TrianglePart::edge_20:
      return point_on_side(placed, face, triangle, 2, to - on.gap, on.gap);
    case TrianglePart::inside:
      break;
  }
  WalkedPoint found;
  found.point = to - on.gap;
  found.gap = on.gap;
  found.squared = on.gap.squaredNorm();
  found.feature = {FeatureKind::face, face};
  found.face = face;
  found.triangle = triangle;
  found.vertices = corners_of(placed, face, triangle);
  found.vertex_count = 3;
  return found;
}

/// Takes the closest point of a triangle if it is nearer.
void offer(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle, const Eigen::Vector3d& to,
           WalkedPoint& best) {
  const TrianglePoints points = triangle_of(placed, face, triangle);
  const TrianglePoint on = closest_on_triangle(to, points);
  if (on.gap.squaredNorm() < best.squared) best = named(placed, face, triangle, points, on, to);
}

/// Whether a way from the point of a surface leads nearer to the other point. A slope of 2^-27 shortens the
/// gap by no more than its rounding.
bool leads_nearer(const Eigen::Vector3d& way, const Eigen::Vector3d& gap, double squared_gap) {
  const double along = way.dot(gap);
  return along > 0 && along * along > 0x1p-54 * squared_gap * way.squaredNorm();
}

/// The triangle of a face at `vertex` that has two other corners, too.
struct TriangleRef {
  std::uint32_t face;
  std::uint8_t triangle;
};
TriangleRef triangle_at(const PlacedMesh& placed, std::uint32_t vertex, std::uint32_t second,
                        std::uint32_t third) {
  const auto faces = placed.mesh.vertex_faces(vertex);
  for (const std::uint32_t face : faces)
    for (std::uint8_t triangle = 0; triangle + 2U < placed.mesh.face(face).size(); ++triangle) {
      const auto corners = corners_of(placed, face, triangle);
      const auto has = [&](std::uint32_t corner) {
        return std::find(corners.begin(), corners.end(), corner) != corners.end();
      };
      if (has(vertex) && has(second) && has(third)) return {face, triangle};
    }
  return {faces[0], 0};  // not reached: the fans are made of these triangles
}

/// Looks for nearer points in the triangles around one vertex.
class FanSearch {
 public:
  /// Writes to `nearer` if there is a nearer point.
  FanSearch(const PlacedMesh& placed, const WalkedPoint& at, const Eigen::Vector3d& to, WalkedPoint& nearer)
      : placed_(placed), at_(at), to_(to), nearer_(nearer), squared_(at.squared) {}

  [[nodiscard]] bool has_found() const { return squared_ < at_.squared; }
  void look_around(std::uint32_t vertex) {
    const Eigen::Vector3d middle = placed_.point(vertex);
    Eigen::Vector3d last = middle;
    std::uint32_t last_corner = vertex;
    bool last_is_nearer = false;
    for (const std::uint32_t corner : placed_.mesh.vertex_fans(vertex)) {
      const Eigen::Vector3d point = placed_.point(corner);
      const bool is_nearer = leads_nearer(point - at_.point, at_.gap, at_.squared);
      // A triangle with all corners behind the plane through the point, square to the gap, is not nearer.
      if ((is_nearer || last_is_nearer) && corner != vertex && last_corner != vertex)
        look_at(vertex, last_corner, corner, {middle, last, point});
      last = point;
      last_corner = corner;
      last_is_nearer = is_nearer;
    }
  }

 private:
  void look_at(std::uint32_t vertex, std::uint32_t second, std::uint32_t third,
               const TrianglePoints& points) {
    const Eigen::Vector3d normal = area_normal(points);
    const double height = normal.dot(to_ - points[0]);
    // The plane of a nearer triangle is nearer, too, but for rounding.
    if (height * height > squared_ * normal.squaredNorm() * (1 + 0x1p-40)) return;
    if (!(closest_on_triangle(to_, points).gap.squaredNorm() < squared_)) return;
    const TriangleRef found = triangle_at(placed_, vertex, second, third);
    const WalkedPoint nearer = closest_on_triangle_of(placed_, found.face, found.triangle, to_);
    if (!(nearer.squared < squared_)) return;
    nearer_ = nearer;
    squared_ = nearer.squared;
  }

  const PlacedMesh& placed_;
  const WalkedPoint& at_;
  const Eigen::Vector3d& to_;
  WalkedPoint& nearer_;
  double squared_;
};

/// Whether a face leads along an edge from its lower vertex to the other one.
bool leads_upward(const PlacedMesh& placed, std::uint32_t face, std::uint32_t edge) {
  const auto edges = placed.mesh.face_edges(face);
  const auto found = std::find(edges.begin(), edges.end(), edge);
  return placed.mesh.face(face)[static_cast<std::size_t>(found - edges.begin())] == placed.mesh.edge(edge)[0];
}

/// Whether an edge does not join two faces that are wound the same way.
bool is_border(const PlacedMesh& placed, std::uint32_t edge) {
  const auto faces = placed.mesh.edge_faces(edge);
  return faces.size() != 2 || leads_upward(placed, faces[0], edge) == leads_upward(placed, faces[1], edge);
}

}  // namespace

WalkedPoint point_at_corner(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle,
                            std::size_t corner, const Eigen::Vector3d& to) {
  WalkedPoint found = at_vertex(placed, corners_of(placed, face, triangle)[corner], to);
  found.face = face;
  found.triangle = triangle;
  return found;
}

WalkedPoint point_on_side(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle,
                          std::size_t side, const Eigen::Vector3d& point, const Eigen::Vector3d& gap) {
  const auto corners = corners_of(placed, face, triangle);
  const std::uint32_t edge = edge_of_side(placed, face, triangle, side);
  WalkedPoint found;
  found.point = point;
  found.gap = gap;
  found.squared = gap.squaredNorm();
  found.feature = edge == Mesh::no_edge ? Feature{FeatureKind::face, face} : Feature{FeatureKind::edge, edge};
  found.face = face;
  found.triangle = triangle;
  found.vertices = {corners[side], corners[(side + 1) % 3], 0};
  found.vertex_count = 2;
  return found;
}

WalkedPoint closest_on_triangle_of(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle,
                                   const Eigen::Vector3d& to) {
  const TrianglePoints points = triangle_of(placed, face, triangle);
  return named(placed, face, triangle, points, closest_on_triangle(to, points), to);
}

WalkedPoint closest_on_feature(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& to) {
  if (feature.kind == FeatureKind::vertex) return at_vertex(placed, feature.index, to);
  if (feature.kind == FeatureKind::edge) return closest_on_edge(placed, feature.index, to);
  WalkedPoint best = closest_on_triangle_of(placed, feature.index, 0, to);
  if (placed.mesh.face(feature.index).size() == 4) offer(placed, feature.index, 1, to, best);
  return best;
}

bool find_nearer(const PlacedMesh& placed, const WalkedPoint& at, const Eigen::Vector3d& to,
                 WalkedPoint& nearer) {
  FanSearch search(placed, at, to, nearer);
  for (const std::uint32_t vertex : at.corners()) search.look_around(vertex);
  return search.has_found();
}

bool is_at_border(const PlacedMesh& placed, const WalkedPoint& at) {
  if (at.feature.kind == FeatureKind::edge) return is_border(placed, at.feature.index);
  if (at.feature.kind == FeatureKind::face) return false;
  // The fan of a vertex inside a surface that is wound one way is one ring.
  const std::uint32_t vertex = at.feature.index;
  const auto fan = placed.mesh.vertex_fans(vertex);
  return fan.empty() || fan.front() != fan.back() || std::find(fan.begin(), fan.end(), vertex) != fan.end();
}

SurfaceWalk walk_to_closest(const PlacedMesh& placed, const Feature& start, const Eigen::Vector3d& to) {
  SurfaceWalk walk;
  walk.end = closest_on_feature(placed, start, to);
  const auto count_step = [&] {
    ++walk.steps;
    walk.met_border = walk.met_border || is_at_border(placed, walk.end);
  };
  if (walk.end.feature != start) count_step();
  for (unsigned round = 0; round <= most_steps; ++round) {
    WalkedPoint nearer;
    if (!find_nearer(placed, walk.end, to, nearer)) {
      walk.has_arrived = true;
      return walk;
    }
    const bool is_other = nearer.feature != walk.end.feature;
    walk.end = nearer;
    if (is_other) count_step();
  }
  return walk;
}

}  // namespace graze
