#pragma once

#include <graze/box.hpp>
#include <graze/mesh.hpp>
#include <graze/region_tree.hpp>
#include <span>

namespace graze {

struct LeafFront;
class Surface;
class VertexBlocks;

/// Structure validators. Each throws std::logic_error naming what does not hold; without GRAZE_VALIDATE they
/// are empty.

/// Every used vertex, face and edge is in exactly one leaf; ranges of children make up their parent's; the
/// middle vertex is one of the region's.
void validate(const RegionTree& tree, const Mesh& mesh);

/// No pair of leaves outside a front that is about surfaces is nearer than it says. Looked at for small
/// surfaces only.
void validate(const LeafFront& front, const Surface& a, const Surface& b);

/// Every region's bounds contain its vertices and the corners of the faces and edges it owns.
void validate(const Surface& surface);

/// Blocks are those of a surface's present positions: each level's boxes contain their vertices.
void validate_blocks(const Surface& surface, const VertexBlocks& blocks);
/// Vertices that are not listed are at least so far from a box along some axis.
void validate_near_part(const Surface& surface, const Box& box, double reach,
                        std::span<const std::uint32_t> listed);

}  // namespace graze
