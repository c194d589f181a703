#pragma once

#include <vector>

#include "closest_features/closest_set.hpp"
#include "core/pair/pair_query.hpp"
#include "leaves/leaf_feature_pairs.hpp"
#include "walk/dmv.hpp"

namespace graze {

struct PaperScratch {
  DmvScratch dmv;
  LeafScratch leaves;
  Closest closest;
  Closest leaf_closest;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.dmv, self.leaves, self.closest, self.leaf_closest);
  }
};

/// The result of the paper's method for a pair.
struct PaperFound {
  bool complete = true;
  /// No vertices are nearer than this: the bounds of what was not expanded, and the distances of what was.
  double lower = std::numeric_limits<double>::infinity();
};

/// Eq. 4: whether the middle vertices are closer than their level's epsilon. Numbers are given for levels 1
/// to k-1, and the last of them is for deeper levels. Without numbers it is eq. 3 summed as in eq. 6, each
/// region by its own level.
bool passes_as_in_paper(const SurfacePair& pair, const PairQuery& query, const Region& a, const Region& b);

/// The paper's method (sections 3.2 and 3.3): DMV with eq. 4's test, and at two leaves DV. It appends the
/// keys of its answer, sorted, each once. With `regions` these are the pairs where DV's walk ended below the
/// threshold. With `vertices` they are all pairs of the leaves reached below it. `scratch.closest` holds the
/// nearest pair of vertices that was met. Both surfaces are refitted by vertices.
PaperFound find_as_in_paper(const SurfacePair& pair, const PairQuery& query, PaperScratch& scratch,
                            WorkMeter& meter, std::vector<FeaturePairKey>& keys);

}  // namespace graze
