#include "response/feature_normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "response/closest_points.hpp"

namespace graze {
namespace {

std::size_t triangle_count(const PlacedMesh& placed, std::uint32_t face) {
  return placed.mesh.face(face).size() - 2;
}

/// The angle of a triangle at its corner `at`.
double angle_at(const TrianglePoints& triangle, std::size_t at) {
  const Eigen::Vector3d u = triangle[(at + 1) % 3] - triangle[at];
  const Eigen::Vector3d v = triangle[(at + 2) % 3] - triangle[at];
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

Eigen::Vector3d vertex_normal(const PlacedMesh& placed, std::uint32_t vertex) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t face : placed.mesh.vertex_faces(vertex)) {
    const auto corners = placed.mesh.face(face);
    for (std::size_t triangle = 0; triangle < triangle_count(placed, face); ++triangle)
      for (std::size_t i = 0; i < 3; ++i) {
        if (corners[triangle_corners[triangle][i]] != vertex) continue;
        const TrianglePoints points = triangle_of(placed, face, triangle);
        sum += unit_normal(points) * angle_at(points, i);
      }
  }
  return sum;
}

/// Whether a triangle of a quad has both ends of an edge. The inner diagonal may join them too, but then the
/// edge is a side of the same quad.
bool has_edge(std::span<const std::uint32_t> corners, std::size_t triangle,
              const std::array<std::uint32_t, 2>& ends) {
  int found = 0;
  for (const std::uint8_t i : triangle_corners[triangle])
    if (corners[i] == ends[0] || corners[i] == ends[1]) ++found;
  return found == 2;
}

/// Visits the triangle of each face at an edge that has this edge.
template <typename Visit>
void visit_triangles_at_edge(const PlacedMesh& placed, std::uint32_t edge, const Visit& visit) {
  const auto ends = placed.mesh.edge(edge);
  for (const std::uint32_t face : placed.mesh.edge_faces(edge)) {
    const auto corners = placed.mesh.face(face);
    if (corners.size() == 3) {
      visit(triangle_of(placed, corners, 0));
      continue;
    }
    for (std::size_t triangle = 0; triangle < 2; ++triangle)
      if (has_edge(corners, triangle, ends)) visit(triangle_of(placed, corners, triangle));
  }
}

Eigen::Vector3d edge_normal(const PlacedMesh& placed, std::uint32_t edge) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  visit_triangles_at_edge(placed, edge,
                          [&](const TrianglePoints& triangle) { sum += unit_normal(triangle); });
  return sum;
}

/// Collects on which side of several triangles a direction leads. Where all agree, so does their averaged
/// normal, whatever the weights.
class SidesOfTriangles {
 public:
  explicit SidesOfTriangles(const Eigen::Vector3d& direction)
      : direction_(direction), squared_(0x1p-72 * direction.squaredNorm()) {}

  /// `normal` is as long as it comes.
  void add(const Eigen::Vector3d& normal) {
    const double along = normal.dot(direction_);
    least_ = std::min(least_, along);
    most_ = std::max(most_, along);
    is_certain_ = is_certain_ || along * along > squared_ * normal.squaredNorm();
  }
  /// `none` where the weights count.
  [[nodiscard]] Side side() const {
    if (!is_certain_ || (least_ < 0 && most_ > 0)) return Side::none;
    return least_ < 0 ? Side::back : Side::front;
  }

 private:
  Eigen::Vector3d direction_;
  double squared_;  ///< the bound of a report for a side that is certain, times the direction's square
  double least_ = 0;
  double most_ = 0;
  bool is_certain_ = false;
};

Side side_of_triangles(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& direction) {
  SidesOfTriangles sides(direction);
  if (feature.kind == FeatureKind::vertex) {
    const Eigen::Vector3d vertex = placed.point(feature.index);
    const auto fan = placed.mesh.vertex_fans(feature.index);
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (const std::uint32_t corner : fan) {
      const Eigen::Vector3d to_corner = placed.point(corner) - vertex;
      sides.add(before.cross(to_corner));
      before = to_corner;
    }
  } else if (feature.kind == FeatureKind::edge) {
    visit_triangles_at_edge(placed, feature.index,
                            [&](const TrianglePoints& triangle) { sides.add(area_normal(triangle)); });
  } else {
    const auto corners = placed.mesh.face(feature.index);
    for (std::size_t triangle = 0; triangle + 2 < corners.size(); ++triangle)
      sides.add(area_normal(triangle_of(placed, corners, triangle)));
  }
  return sides.side();
}

/// A point counts as on the inner diagonal if it is there up to rounding.
Eigen::Vector3d quad_normal(const PlacedMesh& placed, std::uint32_t face, const Eigen::Vector3d& point) {
  const TrianglePoints first = triangle_of(placed, face, 0);
  const TrianglePoints second = triangle_of(placed, face, 1);
  const Segment diagonal{first[0], first[2]};
  const double off_diagonal = (point - closest_on_segment(point, diagonal).point).norm();
  if (off_diagonal < 0x1p-40 * (diagonal[1] - diagonal[0]).norm())
    return unit_normal(first) + unit_normal(second);
  const double off_first = closest_on_triangle(point, first).gap.squaredNorm();
  const double off_second = closest_on_triangle(point, second).gap.squaredNorm();
  return unit_normal(off_first <= off_second ? first : second);
}

}  // namespace

Eigen::Vector3d unit_normal(const TrianglePoints& triangle) {
  const Eigen::Vector3d normal = area_normal(triangle);
  const double length = normal.norm();
  return length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

Side side_along(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& point,
                const Eigen::Vector3d& direction) {
  if (const Side side = side_of_triangles(placed, feature, direction); side != Side::none) return side;
  const double along = normal_at(placed, feature, point).dot(direction.stableNormalized());
  if (!(std::abs(along) > 0x1p-36)) return Side::none;
  return along > 0 ? Side::front : Side::back;
}

Eigen::Vector3d normal_at(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& point) {
  if (feature.kind == FeatureKind::vertex) return vertex_normal(placed, feature.index);
  if (feature.kind == FeatureKind::edge) return edge_normal(placed, feature.index);
  return triangle_count(placed, feature.index) == 1 ? unit_normal(triangle_of(placed, feature.index, 0))
                                                    : quad_normal(placed, feature.index, point);
}

}  // namespace graze
