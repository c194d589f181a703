#include "core/surface/near_leaves.hpp"

#include <algorithm>

#include "core/base/box.hpp"
#include "surface/region_visit.hpp"

namespace graze {
namespace {

/// At most the distance of a box and the faces of a surface, or more than `limit` if it is more than that.
double lower_distance_to(const Surface& about, const Box& box, double limit) {
  double least = limit * round_up + lost_to_underflow;
  double lower = 0;  // of the region that was looked at last
  visit_leaves(
      about, [&](const Box& region) { return (lower = lower_distance(region, box)) < least; },
      [&](const Region& /*leaf*/) { least = lower; });
  return least;
}

}  // namespace

void list_near_leaves(const Surface& about, bool about_is_solid, const Surface& surface, double radius,
                      std::vector<NearLeaf>& near) {
  const RegionTree& tree = surface.mesh().regions();
  double lower = 0;  // of the region that was looked at last
  visit_leaves(
      surface,
      [&](const Box& box) {
        lower = about_is_solid && do_meet(about.box(), box) ? 0 : lower_distance_to(about, box, radius);
        return lower <= radius;
      },
      [&](const Region& leaf) {
        near.push_back({static_cast<std::uint32_t>(tree.number(leaf)), lower});
      });
}

}  // namespace graze
