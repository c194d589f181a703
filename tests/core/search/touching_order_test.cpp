// The order in which pairs of leaves are asked whether they touch, against its own definition.

#include "walk/touching_order.hpp"

#include <algorithm>
#include <set>

#include "core/comparison.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// Every region of the smaller tree has one place, and with it those of the other follow their numbers.
void check_slots(const RegionTree& a, const RegionTree& b) {
  const TouchingOrder order(a, b);
  REQUIRE(order.region_count() == std::min(a.region_count(), b.region_count()));
  REQUIRE(order.scatters_a() == (a.region_count() < b.region_count()));
  std::set<std::uint32_t> seen;
  for (std::uint32_t slot = 0; slot < order.slot_count(); ++slot) {
    const std::uint32_t region = order.region_at(slot);
    REQUIRE(seen.insert(region).second);
    if (region >= order.region_count()) continue;
    const RegionPair pair = order.with_all(region);
    REQUIRE(pair.a == (order.scatters_a() ? region : 0));
    REQUIRE(pair.b == (order.scatters_a() ? 0 : region));
    REQUIRE(order.of(pair) == std::uint64_t{slot} << 32U);
    REQUIRE(order.of({pair.a + (order.scatters_a() ? 0 : 5), pair.b + (order.scatters_a() ? 5 : 0)}) ==
            order.of(pair) + 5);
  }
}

}  // namespace

TEST_CASE("touching order: every region has a slot of its own, whichever surface is scattered") {
  const Surface large = surface_of(shape_of(models::sphere(48, 32)));
  const Surface small = surface_of(shape_of(models::sphere(12, 8)));
  const Surface one = surface_of(shape_of(models::box({1, 1, 1})));
  for (const Surface* a : {&large, &small, &one})
    for (const Surface* b : {&large, &small, &one}) check_slots(a->mesh().regions(), b->mesh().regions());
}

}  // namespace graze::tests
