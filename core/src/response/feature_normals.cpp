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

double sign_along_edge_normal(const PlacedMesh& placed, std::uint32_t edge,
                              const Eigen::Vector3d& direction) {
  double least = 0;
  double most = 0;
  visit_triangles_at_edge(placed, edge, [&](const TrianglePoints& triangle) {
    const double along = area_normal(triangle).dot(direction);
    least = std::min(least, along);
    most = std::max(most, along);
  });
  if (least == 0 || most == 0) return least + most;
  return edge_normal(placed, edge).dot(direction);
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

double sign_along_normal(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& point,
                         const Eigen::Vector3d& direction) {
  if (feature.kind == FeatureKind::edge) return sign_along_edge_normal(placed, feature.index, direction);
  if (feature.kind == FeatureKind::face) {
    const auto corners = placed.mesh.face(feature.index);
    if (corners.size() == 3) return area_normal(triangle_of(placed, corners, 0)).dot(direction);
  }
  return normal_at(placed, feature, point).dot(direction);
}

Eigen::Vector3d normal_at(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& point) {
  if (feature.kind == FeatureKind::vertex) return vertex_normal(placed, feature.index);
  if (feature.kind == FeatureKind::edge) return edge_normal(placed, feature.index);
  return triangle_count(placed, feature.index) == 1 ? unit_normal(triangle_of(placed, feature.index, 0))
                                                    : quad_normal(placed, feature.index, point);
}

}  // namespace graze
