#include "walk/leaf_pairs.hpp"

#include <algorithm>
#include <vector>

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

double LeafPairs::lower_of_self(const RegionPair& leaves, double pierced) {
  const RestGaps& gaps = pair_.groups->self()->rest_gaps();
  if (gaps.of_contacts.empty()) return 0;
  scratch_.motions.begin(pair_.a);
  const auto motion_of = [&](std::uint32_t leaf) -> const LeafMotion& {
    return scratch_.motions.of(leaf, [&] {
      return motion_of_leaf(pair_.a, pair_.a.mesh().regions().region(leaf), gaps.boxes[leaf]);
    });
  };
  const auto gap_of = [&](const std::vector<float>& gap) {
    return static_cast<double>(std::max(gap[leaves.a], gap[leaves.b]));
  };
  const double of_contacts = gap_of(gaps.of_contacts);
  const double of_piercings = gap_of(gaps.of_piercings);
  const double approach = approach_since_rest(motion_of(leaves.a), gaps.boxes[leaves.a], motion_of(leaves.b),
                                              gaps.boxes[leaves.b], std::max(of_contacts, of_piercings));
  if (of_piercings * round_down - approach <= pierced) return 0;
  return std::max(0.0, (of_contacts * round_down - approach) * round_down);
}

}  // namespace graze
