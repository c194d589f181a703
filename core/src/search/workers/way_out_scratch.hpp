#pragma once

#include <tuple>
#include <vector>

#include "base/working_memory.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/pair/near_list.hpp"
#include "solid/contour.hpp"
#include "walk/leaf_pairs.hpp"

namespace graze {

/// Working memory of one thread for ways out. It is taken when the first pair asks for one, or by
/// `reserve_for_ways_out`.
struct WayOutScratch {
  LeafPairList leaves;
  std::vector<FeaturePair> near;
  ContourScratch contour;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.leaves.leaves, self.near, self.contour);
  }
  void reserve(const PairRoom& /*room*/) {}
  void reserve_for_ways_out(const PairRoom& room) {
    leaves.leaves.reserve(room.leaf_pairs);
    near.reserve(4 * ContourScratch::reserved);
    contour.reserve();
  }
};

}  // namespace graze
