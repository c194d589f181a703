#include "walk/leaf_pairs.hpp"

namespace graze {

double LeafPairs::lower_of_long_leaves(const RegionPair& leaves) {
  return lower_of_long(scratch_.long_a.of(leaves.a), scratch_.boxes_a.of(leaves.a),
                       scratch_.long_b.of(leaves.b), scratch_.boxes_b.of(leaves.b));
}

/// By the corners of either leaf along the axes of the other, if that is long.
double LeafPairs::lower_along_long(const RegionPair& leaves) {
  const OrientedBox* const of_a = scratch_.long_a.of(leaves.a);
  const OrientedBox* const of_b = scratch_.long_b.of(leaves.b);
  double lower = 0;
  if (of_a != nullptr) lower = lower_along_axes(*of_a, box_along(*of_a, pair_.b, leaves.b));
  if (of_b != nullptr) lower = std::max(lower, lower_along_axes(*of_b, box_along(*of_b, pair_.a, leaves.a)));
  return lower;
}

}  // namespace graze
