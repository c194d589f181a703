#pragma once

#include <cstdint>

namespace graze {

/// A pair of regions, one of each object.
struct RegionPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

}  // namespace graze
