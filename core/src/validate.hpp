#pragma once

#include <graze/mesh.hpp>
#include <graze/region_tree.hpp>

namespace graze {

class Surface;

/// Structure validators. Each throws std::logic_error naming what does not hold; without GRAZE_VALIDATE they
/// are empty.

/// Every used vertex, face and edge is in exactly one leaf; ranges of children make up their parent's; the
/// middle vertex is one of the region's.
void validate(const RegionTree& tree, const Mesh& mesh);

/// Every region's bounds contain its vertices and the corners of the faces and edges it owns.
void validate(const Surface& surface);

}  // namespace graze
