#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {

/// The order of IndexedMesh::block_order, of a mesh that has its regions.
std::vector<std::uint32_t> block_order_of(const IndexedMesh& mesh);
/// IndexedMesh::stretch_groups, of a mesh that uses all vertices and has that order.
void list_stretch_groups(std::span<const std::uint32_t> order, std::vector<std::uint32_t>& groups,
                         std::vector<std::uint32_t>& begin);

}  // namespace graze
