#pragma once

#include <array>
#include <cstdint>
#include <graze/export.hpp>

#include "core/mesh/region_tree.hpp"

namespace graze {

/// The work done for a pair, or for many. Every member is a 64-bit counter, or an array of them.
struct GRAZE_API PairCounters {
  std::uint64_t region_pairs_tested = 0;
  std::uint64_t leaf_pairs_tested = 0;
  std::uint64_t discarded_in_float = 0;  ///< pairs of features or vertices, of two leaves
  std::uint64_t named_in_float = 0;      ///< contacts, as often as they were found
  std::uint64_t decided_in_double = 0;   ///< questions
  std::uint64_t exact_decisions = 0;     ///< questions that double could not decide
  std::uint64_t fronts_left_out = 0;     ///< fronts that were not kept because of PairQuery::front_limit
  std::uint64_t pairs_by_list = 0;       ///< pairs of objects of which a list of features was asked alone
  /// Pairs of regions expanded, by level.
  std::array<std::uint64_t, RegionTree::max_level + 1> regions_expanded{};

  /// Adds every counter of `other`.
  void add(const PairCounters& other);
};

}  // namespace graze
