#include "pair/bounds.hpp"

namespace graze {

double lower_of_long(const OrientedBox* oriented_a, const Box& box_a, const OrientedBox* oriented_b,
                     const Box& box_b) {
  if (oriented_a == nullptr && oriented_b == nullptr) return 0;
  const OrientedBox a = oriented_a != nullptr ? *oriented_a : OrientedBox::of(box_a);
  const OrientedBox b = oriented_b != nullptr ? *oriented_b : OrientedBox::of(box_b);
  return std::max(oriented_a != nullptr ? lower_along_axes(a, b) : 0,
                  oriented_b != nullptr ? lower_along_axes(b, a) : 0);
}

double RegionBounds::lower_of_long_regions(const RegionPair& pair) const {
  const auto oriented = [](const Surface& surface, std::uint32_t region) -> const OrientedBox* {
    const LongRegions& all = surface.mesh().long_regions();
    const std::uint32_t index = all.empty() ? LongRegions::none : all.index_of(region);
    return index == LongRegions::none ? nullptr : &surface.oriented_boxes()[index];
  };
  return lower_of_long(oriented(a_, pair.a), box_a(pair), oriented(b_, pair.b), box_b(pair));
}

}  // namespace graze
