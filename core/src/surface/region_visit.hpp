#pragma once

#include <cstdint>

#include "base/inplace_vector.hpp"
#include "core/mesh/region_tree.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Visits the leaves of a surface by `use(leaf)`, where `keep(box)` holds for the boxes of their faces and of
/// all regions above them. A surface that has moved since its last refit has looser boxes.
template <typename Keep, typename Use>
void visit_leaves(const Surface& surface, const Keep& keep, const Use& use) {
  const RegionTree& tree = surface.mesh().regions();
  const double slack = surface.motion_since_face_refit();
  // At most the siblings of one region are open on each level.
  InplaceVector<std::uint32_t, std::size_t{8} * (RegionTree::max_level + 1)> open;
  open.push_back(0);
  while (!open.empty()) {
    const std::uint32_t number = open.back();
    open.pop_back();
    const Box& box = surface.face_boxes()[number];
    if (!keep(slack == 0 ? box : grown(box, slack))) continue;
    const Region& region = tree.region(number);
    if (region.is_leaf()) use(region);
    for (std::uint32_t child = 0; child < region.child_count; ++child)
      open.push_back(region.first_child + child);
  }
}

}  // namespace graze
