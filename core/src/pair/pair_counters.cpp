#include "core/pair/pair_counters.hpp"

namespace graze {

void PairCounters::add(const PairCounters& other) {
  region_pairs_tested += other.region_pairs_tested;
  leaf_pairs_tested += other.leaf_pairs_tested;
  discarded_in_float += other.discarded_in_float;
  named_in_float += other.named_in_float;
  decided_in_double += other.decided_in_double;
  exact_decisions += other.exact_decisions;
  fronts_left_out += other.fronts_left_out;
  pairs_by_list += other.pairs_by_list;
  for (std::size_t level = 0; level < regions_expanded.size(); ++level)
    regions_expanded[level] += other.regions_expanded[level];
}

}  // namespace graze
