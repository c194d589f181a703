#include "core/pair/near_list.hpp"

#include <algorithm>

#include "arithmetic/certain.hpp"

namespace graze {

bool NearList::has_vertices_within(const Surface& a, const Surface& b, double threshold) const {
  return std::any_of(pairs.begin(), pairs.end(), [&](const FeaturePair& parts) {
    return squared_range(a.position(parts.a.index), b.position(parts.b.index)).is_below(threshold);
  });
}

}  // namespace graze
