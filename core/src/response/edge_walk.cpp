#include "response/edge_walk.hpp"

#include <algorithm>
#include <array>
#include <utility>

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

struct PointPair {
  SurfacePoint a;
  SurfacePoint b;
};

/// The closest points of two triangles that do not pass through each other.
class TrianglePair {
 public:
  TrianglePair(const PlacedMesh& a, const SurfacePoint& on_a, const PlacedMesh& b, const SurfacePoint& on_b)
      : a_(a), b_(b), on_a_(on_a), on_b_(on_b) {}

  [[nodiscard]] PointPair closest() {
    const TrianglePoints points_a = triangle_of(a_, on_a_.face, on_a_.triangle);
    const TrianglePoints points_b = triangle_of(b_, on_b_.face, on_b_.triangle);
    for (std::size_t i = 0; i < 3; ++i) {
      take({point_at_corner(a_, on_a_.face, on_a_.triangle, i, points_a[i]),
            closest_on_triangle_of(b_, on_b_.face, on_b_.triangle, points_a[i])},
           false);
      take({closest_on_triangle_of(a_, on_a_.face, on_a_.triangle, points_b[i]),
            point_at_corner(b_, on_b_.face, on_b_.triangle, i, points_b[i])},
           true);
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        take_sides(i, {points_a[i], points_a[(i + 1) % 3]}, j, {points_b[j], points_b[(j + 1) % 3]});
    return best_;
  }

 private:
  /// `is_gap_of_a` says whose gap is the right one.
  void take(PointPair found, bool is_gap_of_a) {
    if (is_gap_of_a) {
      found.b.gap = -found.a.gap;
      found.b.squared = found.a.squared;
    } else {
      found.a.gap = -found.b.gap;
      found.a.squared = found.b.squared;
    }
    if (is_first_ || found.a.squared < best_.a.squared) best_ = found;
    is_first_ = false;
  }
  void take_sides(std::size_t side_a, const Segment& a, std::size_t side_b, const Segment& b) {
    const ClosestPoints at = closest_of_segments(a, b);
    if (!at.are_interior || !(at.gap.squaredNorm() < best_.a.squared)) return;
    best_ = {point_on_side(a_, on_a_.face, on_a_.triangle, side_a, at.a, at.gap),
             point_on_side(b_, on_b_.face, on_b_.triangle, side_b, at.b, -at.gap)};
  }

  const PlacedMesh& a_;
  const PlacedMesh& b_;
  const SurfacePoint& on_a_;
  const SurfacePoint& on_b_;
  PointPair best_;
  bool is_first_ = true;
};

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
  walk.a = closest_on_feature(a, {FeatureKind::edge, edge_a}, at.b);
  walk.b = closest_on_feature(b, {FeatureKind::edge, edge_b}, at.a);
  std::array<Feature, 2> last{Feature{FeatureKind::edge, edge_a}, Feature{FeatureKind::edge, edge_b}};
  const auto count_step = [&] {
    const std::array now{walk.a.feature, walk.b.feature};
    if (now != last) ++walk.steps;
    last = now;
  };
  count_step();
  while (may_lead_nearer(a, walk.a) || may_lead_nearer(b, walk.b)) {
    const SurfacePoint on_a = nearest_around(a, walk.a, walk.b.point);
    const SurfacePoint on_b = nearest_around(b, walk.b, walk.a.point);
    if (!(std::min(on_a.squared, on_b.squared) < walk.a.squared)) break;
    const PointPair found = TrianglePair(a, on_a, b, on_b).closest();
    if (!(found.a.squared < walk.a.squared) || walk.steps == most_steps) return walk;
    walk.a = found.a;
    walk.b = found.b;
    count_step();
  }
  walk.has_arrived = walk.a.squared > 0;
  return walk;
}

}  // namespace graze
