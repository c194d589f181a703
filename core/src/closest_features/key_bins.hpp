#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/indexed_mesh.hpp"

namespace graze {

/// Some hundred bins that ascend as keys do, by the kinds of the features and the highest bits of the index
/// of feature a. Several threads find keys in any order, and each puts its own into bins. Then each thread
/// sorts some of the bins, with what all threads have in them.
///
/// Two slices of a stage, whose keys are letters here, and two slices of the next stage:
///
///     slice 1 puts into bins    [0: k a]  [3: p]    [7: z y]
///     slice 2 puts into bins    [0: c]    [3: n o]
///
///     next slice 1 sorts bin 0             a c k
///     next slice 2 sorts bins 3 and 7      n o p  y z
///
/// All keys of a bin come before all of the next. So what the slices sort, one after the other, is in order.
class KeyBins {
 public:
  explicit KeyBins(const IndexedMesh& mesh_a);

  [[nodiscard]] std::size_t of(const FeaturePairKey& key) const {
    const std::uint64_t of_a = key.of_a();
    const auto kind_a = static_cast<std::size_t>(of_a >> 32U & 3U);
    return (static_cast<std::size_t>(of_a >> 40U) * feature_kinds + kind_a) << index_bits |
           static_cast<std::uint32_t>(of_a) >> shift_[kind_a];
  }

  static constexpr std::size_t feature_kinds = 3;
  static constexpr std::size_t contact_kinds = 6;
  static constexpr int index_bits = 5;
  static constexpr std::size_t count = contact_kinds * feature_kinds << index_bits;

 private:
  std::array<int, feature_kinds> shift_;
};

/// Keys of one bin in a list.
struct BinRun {
  std::uint32_t bin;
  std::uint32_t begin;
  std::uint32_t end;
};

/// Puts keys in the order of their bins. Working memory of one thread.
class KeyBinning {
 public:
  /// Says in `runs` where which bin is, but of none that is empty.
  void put_into(const KeyBins& bins, std::vector<FeaturePairKey>& keys, std::vector<BinRun>& runs);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.keys_);
  }
  void reserve(const PairRoom& /*room*/) {}  // only pairs that are cut have bins

 private:
  std::vector<FeaturePairKey> keys_;
};

}  // namespace graze
