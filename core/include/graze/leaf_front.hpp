#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/surface.hpp>
#include <limits>
#include <vector>

namespace graze {

/// A pair of regions, one of each object.
struct RegionPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// Where DMV stopped for one pair of surfaces: every pair of leaves that may have been near, so that the next
/// query, of a detail that is about surfaces or vertices as this one's was, can start there. It stays good
/// while the surfaces move less than it was made loose.
struct LeafFront {
  std::vector<RegionPair> leaves;
  /// Every pair of leaves that is not listed was at least this far apart, at the two marks; negative where
  /// nothing is known.
  double beyond = -1;
  Travel travel_a;
  Travel travel_b;

  void forget() {
    leaves.clear();
    beyond = -1;
  }
  /// No pair of leaves that is not listed is nearer than this now; not positive where nothing is known.
  [[nodiscard]] double beyond_now(const Surface& a, const Surface& b) const {
    if (!(beyond > 0)) return -1;
    if (beyond == std::numeric_limits<double>::infinity()) return beyond;
    const double motion = (a.motion_since(travel_a) + b.motion_since(travel_b)) * round_up;
    return (beyond - motion) * round_down;
  }
};

}  // namespace graze
