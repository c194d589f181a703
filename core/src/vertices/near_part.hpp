#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "base/working_memory.hpp"
#include "core/base/box.hpp"
#include "core/surface/surface.hpp"
#include "core/surface/vertex_blocks.hpp"
#include "vertices/block_boxes.hpp"

namespace graze {

/// Blocks of that part of a surface that may be near something, where the surface has no blocks of all its
/// vertices.
struct NearPart {
  VertexBlocks blocks;
  std::vector<std::uint32_t> order;   ///< of their vertices
  IndexList stretches;                ///< that are near
  std::vector<std::uint64_t> groups;  ///< one bit for each of the mesh, whether it has a vertex of those

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.blocks, self.order, self.stretches, self.groups);
  }
  void reserve(const PairRoom& room);
};

/// Makes the blocks of all groups that have a vertex in a stretch whose box is not certainly further than
/// `reach` from a box.
void make_near_part(const Surface& surface, const Box& box, float reach, NearPart& part);

}  // namespace graze
