#pragma once

namespace graze {

class IndexedMesh;
class RegionTree;

/// Throws std::logic_error where a used vertex, face or edge is not in exactly one leaf. It also throws where
/// the ranges of children do not make up their parent's, or a middle vertex is not one of its region's. Does
/// nothing without GRAZE_VALIDATE.
void validate(const RegionTree& tree, const IndexedMesh& mesh);

}  // namespace graze
