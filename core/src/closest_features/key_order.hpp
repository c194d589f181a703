#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"

namespace graze {

/// Sorts keys. Long lists are sorted digit by digit as numbers that hold all of a key. That takes a few steps
/// for each key, whatever their order.
class KeyOrder {
 public:
  void sort(std::span<FeaturePairKey> keys);
  /// Makes room to sort so many before a deadline, where there is one. Throws TimeIsUp.
  void make_room(std::size_t count, TimeLimit* time);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.packed_, self.spare_);
  }
  void reserve(const PairRoom& room) {
    for (auto* const list : {&packed_, &spare_}) list->reserve(keys_of_contact * room.contacts);
  }

 private:
  void sort_packed();

  std::vector<std::uint64_t> packed_;
  std::vector<std::uint64_t> spare_;
};

}  // namespace graze
