#pragma once

namespace graze {

class IndexedMesh;
class RegionTree;

/// Throws std::logic_error where not every used vertex, face and edge is in exactly one leaf, the ranges of
/// children do not make up their parent's, or a middle vertex is not one of its region's. Does nothing
/// without GRAZE_VALIDATE.
void validate(const RegionTree& tree, const IndexedMesh& mesh);

}  // namespace graze
