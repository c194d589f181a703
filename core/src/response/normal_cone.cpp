#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <graze/contact_geometry.hpp>

#include "closest_features/lean.hpp"
#include "core/base/floating_point_scope.hpp"
#include "response/feature_points.hpp"

namespace graze {
namespace {

// The directions here have length 1.

bool is_in_cone_of_vertex(const PlacedMesh& placed, std::uint32_t vertex, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d point = placed.point(vertex);
  const auto neighbours = placed.mesh.vertex_neighbours(vertex);
  return std::none_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t neighbour) {
    return leads_along(placed.point(neighbour) - point, direction);
  });
}

bool is_in_cone_of_edge(const PlacedMesh& placed, std::uint32_t edge, const Eigen::Vector3d& direction) {
  const std::array<std::uint32_t, 2> ends = placed.mesh.edge(edge);
  const Eigen::Vector3d start = placed.point(ends[0]);
  const Eigen::Vector3d along = placed.point(ends[1]) - start;
  const auto corners = placed.mesh.edge_across(edge);
  return std::none_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
    return leads_along(square_to(along, placed.point(corner) - start), direction);
  });
}

bool is_square_to_face(const PlacedMesh& placed, std::uint32_t face, const Eigen::Vector3d& direction) {
  const auto corners = placed.mesh.face(face);
  for (std::size_t triangle = 0; triangle + 2 < corners.size(); ++triangle) {
    const Eigen::Vector3d normal = area_normal(triangle_of(placed, corners, triangle));
    const double height = normal.dot(direction);
    if (height * height >= (1 - 1 / inverse_squared_lean) * normal.squaredNorm()) return true;
  }
  return false;
}

}  // namespace

bool in_normal_cone(const Mesh& mesh, PositionView positions, const Feature& feature,
                    const Eigen::Vector3d& direction) {
  const PlacedMesh placed{indexed(mesh), positions};
  check_feature(placed, feature, "in_normal_cone");
  const BriefFloatingPointScope scope;
  const Eigen::Vector3d way = direction.stableNormalized();
  if (feature.kind == FeatureKind::face) return is_square_to_face(placed, feature.index, way);
  if (feature.kind == FeatureKind::edge) return is_in_cone_of_edge(placed, feature.index, way);
  return is_in_cone_of_vertex(placed, feature.index, way);
}

}  // namespace graze
