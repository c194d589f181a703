#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <graze/contact.hpp>
#include <graze/position_view.hpp>
#include <span>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {

/// A mesh at positions of the caller's.
struct PlacedMesh {
  const IndexedMesh& mesh;
  const PositionView& positions;

  [[nodiscard]] Eigen::Vector3d point(std::uint32_t vertex) const { return positions[vertex]; }
};

/// The corners of one triangle of a face, by their places in the face: a quad is split from its first corner.
constexpr std::array<std::array<std::uint8_t, 3>, 2> triangle_corners{{{0, 1, 2}, {0, 2, 3}}};

using Segment = std::array<Eigen::Vector3d, 2>;
using TrianglePoints = std::array<Eigen::Vector3d, 3>;

/// The normal of a triangle by its winding, twice as long as its area is large.
inline Eigen::Vector3d area_normal(const TrianglePoints& triangle) {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
}

/// Triangle 0 of a face with these corners, or triangle 1 of a quad.
inline TrianglePoints triangle_of(const PlacedMesh& placed, std::span<const std::uint32_t> corners,
                                  std::size_t triangle) {
  const auto& [i, j, k] = triangle_corners[triangle];
  return {placed.point(corners[i]), placed.point(corners[j]), placed.point(corners[k])};
}
inline TrianglePoints triangle_of(const PlacedMesh& placed, std::uint32_t face, std::size_t triangle) {
  return triangle_of(placed, placed.mesh.face(face), triangle);
}

[[noreturn]] void refuse_feature(const PlacedMesh& placed, const Feature& feature, const char* function);

/// Throws Error, with the name of the caller's function, unless the mesh has the feature and as many vertices
/// as there are positions, and unless these have memory.
inline void check_feature(const PlacedMesh& placed, const Feature& feature, const char* function) {
  const std::array counts{placed.mesh.vertex_count(), placed.mesh.edge_count(), placed.mesh.face_count()};
  const auto kind = static_cast<std::size_t>(feature.kind);
  if (placed.positions.size() != counts[0] || placed.positions.data() == nullptr || kind >= counts.size() ||
      feature.index >= counts[kind])
    refuse_feature(placed, feature, function);
}

}  // namespace graze
