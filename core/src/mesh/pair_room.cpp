#include "core/mesh/pair_room.hpp"

#include <algorithm>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {

void PairRoom::include(const IndexedMesh& mesh) {
  const auto all = mesh.regions().regions();
  vertices = std::max<std::size_t>(vertices, mesh.vertex_count());
  regions = std::max(regions, all.size());
  long_regions = std::max(long_regions, mesh.long_regions().count());
  for (const Region& region : all) {
    if (!region.is_leaf()) continue;
    leaf_vertices = std::max<std::size_t>(leaf_vertices, region.vertex_count);
    leaf_edges = std::max<std::size_t>(leaf_edges, region.edge_count);
    leaf_faces = std::max<std::size_t>(leaf_faces, region.face_count);
  }
}

}  // namespace graze
