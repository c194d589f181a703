#pragma once

#include <cstdint>
#include <graze/mesh.hpp>
#include <span>
#include <vector>

namespace graze {

/// The order of Mesh::block_order, of a mesh that has its regions.
std::vector<std::uint32_t> block_order_of(const Mesh& mesh);
/// Mesh::stretch_groups, of a mesh that uses all vertices and has that order.
void list_stretch_groups(std::span<const std::uint32_t> order, std::vector<std::uint32_t>& groups,
                         std::vector<std::uint32_t>& begin);

}  // namespace graze
