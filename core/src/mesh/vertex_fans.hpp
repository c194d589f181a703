#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {

/// IndexedMesh::vertex_fans of all vertices, one after the other, and where each begins. From the mesh's
/// faces and the faces of its vertices.
void list_fans(const IndexedMesh& mesh, std::vector<std::uint32_t>& fans, std::vector<std::uint32_t>& begin);

}  // namespace graze
