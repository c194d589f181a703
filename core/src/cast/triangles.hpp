#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "arithmetic/certain.hpp"
#include "closest_features/closest_features.hpp"
#include "core/cast/ray_cast.hpp"

namespace graze {

/// The positions of a triangle's corners.
inline std::array<Eigen::Vector3d, 3> corners_of(const Surface& surface, const TriangleOfFace& triangle) {
  const auto corner = surface.mesh().face(triangle.face);
  return {surface.position(corner[0]), surface.position(corner[triangle.second + std::size_t{1}]),
          surface.position(corner[triangle.second + std::size_t{2}])};
}

/// The box of a triangle.
inline Box box_of(const std::array<Eigen::Vector3d, 3>& corner) {
  return {corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]),
          corner[0].cwiseMax(corner[1]).cwiseMax(corner[2])};
}

/// Calls `use(triangle)` with the triangles that a leaf owns and that are not hidden.
template <typename Use>
void visit_triangles(const Surface& surface, const Region& leaf, const FaceGroups* groups, const Use& use) {
  for (const std::uint32_t face : surface.mesh().regions().faces(leaf)) {
    if (groups != nullptr && groups->hides(face)) continue;
    const std::uint32_t triangles = triangle_count(surface.mesh(), face);
    for (std::uint8_t second = 0; second < triangles; ++second) use(TriangleOfFace{face, second});
  }
}

/// The feature that a part of a triangle belongs to.
Feature feature_of_part(const IndexedMesh& mesh, const TriangleOfFace& triangle, VoronoiRegion part);

}  // namespace graze
