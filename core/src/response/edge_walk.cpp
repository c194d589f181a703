#include "response/edge_walk.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "closest_features/lean.hpp"

namespace graze {
namespace {

/// Whether no corner across from an edge leads nearer along `gap`, which is square to the edge.
bool has_all_behind(const PlacedMesh& placed, std::uint32_t edge, const Eigen::Vector3d& gap) {
  const auto ends = placed.mesh.edge(edge);
  const Eigen::Vector3d start = placed.point(ends[0]);
  const Eigen::Vector3d along = placed.point(ends[1]) - start;
  const double length = along.squaredNorm();
  const auto across = placed.mesh.edge_across(edge);
  return std::none_of(across.begin(), across.end(), [&](std::uint32_t corner) {
    const Eigen::Vector3d way = placed.point(corner) - start;
    const double rise = way.dot(gap);
    // A slope of 2^-27 shortens the gap by no more than its rounding.
    return rise > 0 && rise * rise * length > 0x1p-54 * gap.squaredNorm() * along.cross(way).squaredNorm();
  });
}

bool has_in_cone(const PlacedMesh& placed, std::uint32_t edge, const Eigen::Vector3d& direction) {
  const auto ends = placed.mesh.edge(edge);
  const Eigen::Vector3d start = placed.point(ends[0]);
  const Eigen::Vector3d along = placed.point(ends[1]) - start;
  const auto across = placed.mesh.edge_across(edge);
  return std::none_of(across.begin(), across.end(), [&](std::uint32_t corner) {
    return leads_along(square_to(along, placed.point(corner) - start), direction);
  });
}

/// Which points of two triangles are closest: a corner and a triangle, or two sides.
struct ClosestOfTriangles {
  enum class Kind : std::uint8_t { none, corner_of_a, corner_of_b, sides };
  Kind kind = Kind::none;
  std::uint8_t i = 0;  ///< the corner, or the side of a
  std::uint8_t j = 0;  ///< the side of b
  double squared = std::numeric_limits<double>::infinity();
  ClosestPoints at{};  ///< of sides

  void take_corner(Kind of, std::uint8_t corner, const Eigen::Vector3d& point, const TrianglePoints& other) {
    const double found = closest_on_triangle(point, other).gap.squaredNorm();
    if (!(found < squared)) return;
    kind = of;
    i = corner;
    squared = found;
  }
  void take_sides(std::uint8_t side_a, const Segment& a, std::uint8_t side_b, const Segment& b) {
    const ClosestPoints found = closest_of_segments(a, b);
    if (!found.are_interior || !(found.gap.squaredNorm() < squared)) return;
    kind = Kind::sides;
    i = side_a;
    j = side_b;
    at = found;
    squared = found.gap.squaredNorm();
  }
};

/// Moves the points of a walk to the closest points of the two triangles that hold `on_a` and `on_b`. These
/// do not pass through each other. Leaves the walk as it is and returns false if that is no nearer.
bool move_to_closest(const PlacedMesh& a, const WalkedPoint& on_a, const PlacedMesh& b,
                     const WalkedPoint& on_b, PairWalk& walk) {
  using Kind = ClosestOfTriangles::Kind;
  const TrianglePoints points_a = triangle_of(a, on_a.face, on_a.triangle);
  const TrianglePoints points_b = triangle_of(b, on_b.face, on_b.triangle);
  ClosestOfTriangles best;
  for (std::uint8_t i = 0; i < 3; ++i) {
    best.take_corner(Kind::corner_of_a, i, points_a[i], points_b);
    best.take_corner(Kind::corner_of_b, i, points_b[i], points_a);
  }
  for (std::uint8_t i = 0; i < 3; ++i)
    for (std::uint8_t j = 0; j < 3; ++j)
      best.take_sides(i, {points_a[i], points_a[(i + 1U) % 3]}, j, {points_b[j], points_b[(j + 1U) % 3]});
  if (!(best.squared < walk.a.squared)) return false;
  if (best.kind == Kind::sides) {
    walk.a = point_on_side(a, on_a.face, on_a.triangle, best.i, best.at.a, best.at.gap);
    walk.b = point_on_side(b, on_b.face, on_b.triangle, best.j, best.at.b, -best.at.gap);
  } else if (best.kind == Kind::corner_of_a) {
    walk.a = point_at_corner(a, on_a.face, on_a.triangle, best.i, points_a[best.i]);
    walk.b = closest_on_triangle_of(b, on_b.face, on_b.triangle, points_a[best.i]);
    walk.a.gap = -walk.b.gap;
    walk.a.squared = walk.b.squared;
  } else {
    walk.b = point_at_corner(b, on_b.face, on_b.triangle, best.i, points_b[best.i]);
    walk.a = closest_on_triangle_of(a, on_a.face, on_a.triangle, points_b[best.i]);
    walk.b.gap = -walk.a.gap;
    walk.b.squared = walk.a.squared;
  }
  return true;
}

/// The closest point of an edge to `to`, with a triangle at the edge.
WalkedPoint point_of_edge(const PlacedMesh& placed, std::uint32_t edge, const Eigen::Vector3d& to) {
  WalkedPoint found = closest_on_feature(placed, {FeatureKind::edge, edge}, to);
  found.face = placed.mesh.edge_faces(edge)[0];
  // The sides of a quad's first triangle are its first two edges.
  const auto edges = placed.mesh.face_edges(found.face);
  found.triangle = edges.size() == 4 && edges[0] != edge && edges[1] != edge ? 1 : 0;
  return found;
}

}  // namespace

bool are_locally_closest(const PlacedMesh& a, std::uint32_t edge_a, const PlacedMesh& b, std::uint32_t edge_b,
                         const ClosestPoints& at) {
  return has_all_behind(a, edge_a, at.gap) && has_all_behind(b, edge_b, -at.gap);
}

bool bound_patch(const PlacedMesh& a, std::uint32_t edge_a, const PlacedMesh& b, std::uint32_t edge_b,
                 const ClosestPoints& at, bool are_sunk) {
  if (!a.mesh.is_crease(edge_a) || !b.mesh.is_crease(edge_b)) return false;
  const Eigen::Vector3d direction = are_sunk ? Eigen::Vector3d(-at.gap) : at.gap;
  const Eigen::Vector3d way = direction.stableNormalized();
  return has_in_cone(a, edge_a, way) && has_in_cone(b, edge_b, -way);
}

PairWalk walk_together(const PlacedMesh& a, std::uint32_t edge_a, const PlacedMesh& b, std::uint32_t edge_b,
                       const ClosestPoints& at) {
  PairWalk walk;
  walk.a = point_of_edge(a, edge_a, at.b);
  walk.b = point_of_edge(b, edge_b, at.a);
  std::array<Feature, 2> last{Feature{FeatureKind::edge, edge_a}, Feature{FeatureKind::edge, edge_b}};
  const auto count_step = [&] {
    const std::array now{walk.a.feature, walk.b.feature};
    if (now != last) ++walk.steps;
    last = now;
  };
  count_step();
  for (unsigned round = 0; round <= most_steps_together; ++round) {
    WalkedPoint on_a = walk.a;
    WalkedPoint on_b = walk.b;
    const bool leads_nearer_a = find_nearer(a, walk.a, walk.b.point, on_a);
    const bool leads_nearer_b = find_nearer(b, walk.b, walk.a.point, on_b);
    if (!leads_nearer_a && !leads_nearer_b) {
      walk.has_arrived = walk.a.squared > 0;
      return walk;
    }
    if (!move_to_closest(a, on_a, b, on_b, walk)) return walk;
    count_step();
  }
  return walk;
}

}  // namespace graze
