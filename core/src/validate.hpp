#pragma once

#include <graze/mesh.hpp>
#include <graze/region_tree.hpp>

namespace graze {

struct LeafFront;
class Surface;

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

/// A surface's blocks are those of its present positions, and each level's boxes contain their vertices.
void validate_blocks(const Surface& surface);

}  // namespace graze
