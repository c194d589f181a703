#include "core/surface/near_leaves.hpp"

#include <algorithm>
#include <array>

#include "core/base/box.hpp"

namespace graze {
namespace {

/// A child of a region of at most eight goes onto the stack before any of its own.
constexpr std::size_t most_open = std::size_t{8} * (RegionTree::max_level + 1);

/// Calls `use(leaf)` for each leaf in whose regions `may(box)` holds throughout. What `may` says may change
/// from call to call.
template <typename May, typename Use>
void visit_leaves_where(const Surface& surface, const May& may, const Use& use) {
  const RegionTree& tree = surface.mesh().regions();
  std::array<std::uint32_t, most_open> open;
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const std::uint32_t index = open[--count];
    if (!may(surface.face_boxes()[index])) continue;
    const Region& region = tree.region(index);
    if (region.is_leaf()) use(index);
    for (std::uint32_t child = 0; child < region.child_count; ++child)
      open[count++] = region.first_child + child;
  }
}

/// At most the distance of a box and the faces of a surface, or more than `limit` if it is more than that.
double lower_distance_to(const Surface& about, const Box& box, double limit) {
  double least = limit * round_up + lost_to_underflow;
  visit_leaves_where(
      about, [&](const Box& region) { return lower_distance(region, box) < least; },
      [&](std::uint32_t leaf) { least = std::min(least, lower_distance(about.face_boxes()[leaf], box)); });
  return least;
}

}  // namespace

void list_near_leaves(const Surface& about, bool about_is_solid, const Surface& surface, double radius,
                      std::vector<NearLeaf>& near) {
  const auto lower_of = [&](const Box& box) {
    return about_is_solid && do_meet(about.box(), box) ? 0 : lower_distance_to(about, box, radius);
  };
  visit_leaves_where(
      surface,
      [&](const Box& box) { return lower_distance(about.box(), box) <= radius && lower_of(box) <= radius; },
      [&](std::uint32_t leaf) {
        near.push_back({leaf, lower_of(surface.face_boxes()[leaf])});
      });
}

}  // namespace graze
