#pragma once

#include <graze/contact.hpp>
#include <tuple>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"
#include "leaves/touching_edges.hpp"
#include "solid/vertices_in_solid.hpp"
#include "walk/leaf_pairs.hpp"

namespace graze {

/// Working memory of one thread for pairs with a solid. It is taken when the first such pair is met, or by
/// `reserve_for_solids`.
struct SolidScratch {
  VerticesInSolid a_in_b;
  VerticesInSolid b_in_a;
  TouchingEdges touching;
  LeafPairList touching_leaves;
  std::vector<FeaturePairKey> keys;
  std::vector<Contact> contacts;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.a_in_b, self.b_in_a, self.touching, self.touching_leaves.leaves, self.keys,
                    self.contacts);
  }
  void reserve(const PairRoom& /*room*/) {}
  void reserve_for_solids(const PairRoom& room) {
    a_in_b.reserve(room);
    b_in_a.reserve(room);
    touching.reserve();
    touching_leaves.leaves.reserve(room.leaf_pairs);
    keys.reserve(keys_of_contact * room.ties);
    contacts.reserve(room.contacts);
  }
};

}  // namespace graze
