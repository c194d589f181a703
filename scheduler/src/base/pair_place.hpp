#pragma once

#include <cstdint>

namespace graze {

/// Says which pairs of an object are tested in this scene, and not in that of another process. A pair is
/// tested if one object offers what the other seeks. By default every pair is.
struct PairPlace {
  std::uint8_t offers = 1;  ///< a set of bits
  std::uint8_t seeks = 1;   ///< a set of bits

  friend bool operator==(const PairPlace&, const PairPlace&) = default;
};

}  // namespace graze
