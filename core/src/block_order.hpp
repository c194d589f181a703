#pragma once

#include <cstdint>
#include <graze/mesh.hpp>
#include <vector>

namespace graze {

/// The order of Mesh::block_order, of a mesh that has its regions.
std::vector<std::uint32_t> block_order_of(const Mesh& mesh);

}  // namespace graze
