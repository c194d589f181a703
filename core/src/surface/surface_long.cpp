// The part of a surface that bounds long regions by boxes along their faces.

#include "core/surface/surface.hpp"
#include "surface/long_leaf_boxes.hpp"

namespace graze {

Eigen::Matrix3d Surface::axes_of(const LongRegions::LongRegion& region) const {
  const auto& [first, second, third] = region.corners;
  return axes_through({position(first), position(second), position(third)});
}

OrientedBox Surface::oriented_box_now(const LongRegions::LongRegion& leaf) const {
  OrientedBox axes;
  axes.axes = axes_of(leaf);
  axes.origin = position(leaf.corners[0]);
  return box_along(axes, *this, leaf.region);
}

OrientedBox box_along(const OrientedBox& axes, const Surface& surface, std::uint32_t leaf) {
  const RegionTree& tree = surface.mesh().regions();
  const Region& region = tree.region(leaf);
  OrientedExtent extent(axes.axes, axes.origin);
  for (const auto& list : {tree.vertices(region), tree.border(region)})
    for (const std::uint32_t vertex : list) extent.add(surface.position(vertex));
  return extent.box();
}

/// The boxes of those long leaves that are in a range of regions.
void Surface::refit_long_leaves(std::uint32_t begin, std::uint32_t end) {
  const auto regions = mesh_->long_regions().all();
  for (std::size_t index = 0; index < regions.size(); ++index) {
    const LongRegions::LongRegion& each = regions[index];
    if (each.region >= begin && each.region < end && mesh_->regions().region(each.region).is_leaf())
      oriented_boxes_[index] = oriented_box_now(each);
  }
}

/// Long regions come after all that they contain, so the boxes of these are already those of now.
void Surface::box_inner_long_regions() {
  const LongRegions& all = mesh_->long_regions();
  for (std::size_t index = 0; index < all.count(); ++index) {
    const LongRegions::LongRegion& each = all.all()[index];
    const Region& region = mesh_->regions().region(each.region);
    if (region.is_leaf()) continue;
    OrientedExtent extent(axes_of(each), position(each.corners[0]));
    for (std::uint32_t child = region.first_child; child < region.first_child + region.child_count; ++child) {
      const std::uint32_t of_child = all.index_of(child);
      extent.add(of_child == LongRegions::none ? OrientedBox::of(face_boxes_[child])
                                               : oriented_boxes_[of_child]);
    }
    oriented_boxes_[index] = extent.box();
  }
}

}  // namespace graze
