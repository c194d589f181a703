#pragma once

#include <cstddef>
#include <cstdint>

#include "base/inplace_vector.hpp"
#include "core/cast/ray.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Visits the leaves of a surface by `use(leaf)`, first those that a ray enters first. `limit()` is the t
/// beyond which nothing is asked for any more. It may fall in `use`. Boxes count as grown by `margin`. The
/// surface has been refitted for faces now.
template <typename Limit, typename Use>
void visit_leaves_along(const Ray& ray, const Surface& surface, double margin, const Limit& limit,
                        const Use& use) {
  struct Open {
    double entry;
    std::uint32_t region;
  };
  const RayBoxTest test(ray);
  const RegionTree& tree = surface.mesh().regions();
  const auto boxes = surface.face_boxes();
  double last = limit();
  const auto entry_of = [&](std::uint32_t region) {
    return test.entry(margin == 0 ? boxes[region] : grown(boxes[region], margin), last);
  };
  // At most the siblings of one region are open on each level.
  InplaceVector<Open, std::size_t{8} * (RegionTree::max_level + 1)> open;
  if (const double entry = entry_of(0); entry != RayBoxTest::miss) open.push_back({entry, 0});
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    if (next.entry > last) continue;
    const Region& region = tree.region(next.region);
    if (region.is_leaf()) {
      use(region);
      last = limit();
      continue;
    }
    const std::size_t first = open.size();
    for (std::uint32_t child = region.first_child; child < region.first_child + region.child_count; ++child) {
      const double entry = entry_of(child);
      if (entry == RayBoxTest::miss) continue;
      // Sorts the siblings by their entry, the nearest last.
      open.push_back({entry, child});
      for (std::size_t i = open.size() - 1; i > first && open[i - 1].entry < open[i].entry; --i)
        std::swap(open[i - 1], open[i]);
    }
  }
}

}  // namespace graze
