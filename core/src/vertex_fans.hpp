#pragma once

#include <cstdint>
#include <graze/mesh.hpp>
#include <vector>

namespace graze {

/// Mesh::vertex_fans of all vertices, one after the other, and where each begins. From the mesh's faces and
/// the faces of its vertices.
void list_fans(const Mesh& mesh, std::vector<std::uint32_t>& fans, std::vector<std::uint32_t>& begin);

}  // namespace graze
