#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <graze/contact_geometry.hpp>

#include "core/base/floating_point_scope.hpp"
#include "response/feature_points.hpp"

namespace graze {
namespace {

constexpr double squared_sine = 1.0 / 32;  // as for the edges of `nearest`

/// Whether a way along the surface leads ahead, seen along the direction, by more than the tolerance.
bool leads_ahead(const Eigen::Vector3d& way, const Eigen::Vector3d& direction) {
  const double ahead = way.dot(direction);
  return ahead > 0 && ahead * ahead > squared_sine * way.squaredNorm() * direction.squaredNorm();
}

bool is_ahead_of_vertex(const PlacedMesh& placed, std::uint32_t vertex, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d point = placed.point(vertex);
  const auto neighbours = placed.mesh.vertex_neighbours(vertex);
  return std::any_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t neighbour) {
    return leads_ahead(placed.point(neighbour) - point, direction);
  });
}

bool is_ahead_of_edge(const PlacedMesh& placed, std::uint32_t edge, const Eigen::Vector3d& direction) {
  const std::array<std::uint32_t, 2> ends = placed.mesh.edge(edge);
  const Eigen::Vector3d start = placed.point(ends[0]);
  const Eigen::Vector3d along = placed.point(ends[1]) - start;
  const auto corners = placed.mesh.edge_across(edge);
  return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
    const Eigen::Vector3d to_corner = placed.point(corner) - start;
    const Eigen::Vector3d inward = along.squaredNorm() * to_corner - along * to_corner.dot(along);
    return leads_ahead(inward, direction);
  });
}

bool is_square_to_face(const PlacedMesh& placed, std::uint32_t face, const Eigen::Vector3d& direction) {
  const auto corners = placed.mesh.face(face);
  for (std::size_t triangle = 0; triangle + 2 < corners.size(); ++triangle) {
    const Eigen::Vector3d normal = area_normal(triangle_of(placed, corners, triangle));
    const double height = normal.dot(direction);
    if (height * height >= (1 - squared_sine) * normal.squaredNorm() * direction.squaredNorm()) return true;
  }
  return false;
}

}  // namespace

bool in_normal_cone(const Mesh& mesh, PositionView positions, const Feature& feature,
                    const Eigen::Vector3d& direction) {
  const PlacedMesh placed{indexed(mesh), positions};
  check_feature(placed, feature, "in_normal_cone");
  const BriefFloatingPointScope scope;
  if (feature.kind == FeatureKind::face) return is_square_to_face(placed, feature.index, direction);
  if (feature.kind == FeatureKind::edge) return !is_ahead_of_edge(placed, feature.index, direction);
  return !is_ahead_of_vertex(placed, feature.index, direction);
}

}  // namespace graze
