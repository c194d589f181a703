#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <span>
#include <vector>

#include "object_summary.hpp"
#include "pair_filter.hpp"
#include "place_pair.hpp"
#include "task_pool.hpp"

namespace graze {

/// Of the pairs that the broad phase keeps, those that have to be looked at. Stepping thread only.
class PairSelection {
 public:
  /// The pairs that pass the filters, of which no object is frozen, and whose boxes are within reach or meet;
  /// in the same order. Stands until the next call. Counts in `statistics` what was left out and why.
  std::span<const PlacePair> select(std::span<const PlacePair> pairs, const ObjectSummaries& summaries,
                                    const PairFilter& filter, TaskPool& tasks, StepStatistics& statistics);

  /// Makes room for so many pairs that the broad phase keeps.
  void reserve(std::size_t pairs);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// What one task counts and finds. It finds at most as many as it is given, and puts them where it is given
  /// them.
  struct Slice {
    std::size_t selected = 0;
    std::uint64_t fixed = 0, layer = 0, group = 0, ignored = 0, apart = 0;
  };
  static bool takes(const ObjectSummary& a, const ObjectSummary& b, const PairFilter& filter, Slice& slice);

  std::vector<PlacePair> selected_;
  std::vector<Slice> slices_;
};

/// Whether boxes so far apart, by lower_distance, leave a pair within `reach`. Boxes that meet do at any
/// reach.
inline bool may_be_near(double lower, double reach) {
  return lower < reach || !(lower > 0);
}

}  // namespace graze
