#pragma once

#include <cstdint>

#include "core/mesh/region_tree.hpp"
#include "core/pair/leaf_front.hpp"

namespace graze {

/// Which regions of a pair make way for their children.
struct Expansion {
  bool a = false;
  bool b = false;
};

/// Expands only the larger of two regions of very different size: with a pebble and a planet one way down the
/// planet is walked, not one for each part of the pebble. Otherwise expands both, as in the paper.
inline Expansion expansion_by_size(const Region& a, double size_a, const Region& b, double size_b) {
  constexpr double very_different = 4;
  if (size_a > very_different * size_b && !a.is_leaf()) return {true, false};
  if (size_b > very_different * size_a && !b.is_leaf()) return {false, true};
  return {true, true};
}

/// The regions that take the places of two regions: children, or the region itself where it stays.
struct RegionChildren {
  std::uint32_t first_a;
  std::uint32_t first_b;
  std::uint32_t count_a = 1;
  std::uint32_t count_b = 1;

  /// A leaf always stays.
  RegionChildren(const RegionPair& pair, const Region& a, const Region& b, const Expansion& expansion)
      : first_a(pair.a), first_b(pair.b) {
    if (expansion.a && !a.is_leaf()) {
      first_a = a.first_child;
      count_a = a.child_count;
    }
    if (expansion.b && !b.is_leaf()) {
      first_b = b.first_child;
      count_b = b.child_count;
    }
  }

  /// Calls `use(pair)` with each pair of them.
  template <typename Use>
  void visit(const Use& use) const {
    for (std::uint32_t i = 0; i < count_a; ++i)
      for (std::uint32_t j = 0; j < count_b; ++j) use(RegionPair{first_a + i, first_b + j});
  }
};

/// Calls `use(pair)` with each two children of a region, and each child with itself: the pairs that a region
/// with itself makes way for.
template <typename Use>
void visit_with_itself(const Region& region, const Use& use) {
  const std::uint32_t end = region.first_child + region.child_count;
  for (std::uint32_t a = region.first_child; a < end; ++a)
    for (std::uint32_t b = a; b < end; ++b) use(RegionPair{a, b});
}

}  // namespace graze
