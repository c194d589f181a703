#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "models/implicit.hpp"

namespace graze::models {

struct TriangleMesh {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A closed mesh of the body's surface, wound outward: one vertex in each cell of a grid that the surface
/// passes, one quad (two triangles) across each grid edge that it cuts. The body must lie inside the box from
/// -extent to +extent, and its parts and gaps be wider than two cells.
TriangleMesh surface_net(const Field& field, const Eigen::Vector3d& extent, double cell);

/// Thins the mesh to exactly `vertex_count` by collapsing its shortest edges first, as measured by `size`
/// (the edge length wanted at a place, up to a factor), then evens out the triangles on the body's surface.
TriangleMesh thinned(const TriangleMesh& mesh, const Field& field, const Field& size,
                     std::size_t vertex_count);

}  // namespace graze::models
