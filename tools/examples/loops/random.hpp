#pragma once

#include <cstdint>

namespace loops {

/// Returns a number from 0 to 1 that looks random. It is the same on every machine, unlike those of
/// `<random>`'s distributions.
inline double random_number(std::uint32_t seed) {
  std::uint32_t bits = seed * 747796405u + 2891336453u;
  bits = ((bits >> ((bits >> 28u) + 4u)) ^ bits) * 277803737u;
  bits = (bits >> 22u) ^ bits;
  return static_cast<double>(bits) / 4294967296.0;
}

}  // namespace loops
