#pragma once

#include <cstdint>
#include <graze/mesh.hpp>
#include <string>

namespace graze::io {

/// The counts of a mesh in a page.
struct MeshCounts {
  std::uint32_t vertices = 0;
  std::uint32_t edges = 0;
  std::uint32_t triangles = 0;
  std::uint32_t quads = 0;
  std::uint32_t levels = 0;  ///< of its octree of regions, with level 0
};

MeshCounts page_counts_of(const Mesh& mesh);

/// The table of a mesh: its faces, edges, rest shape and regions.
std::string mesh_table(const Mesh& mesh);

}  // namespace graze::io
