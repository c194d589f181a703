#pragma once

#include <algorithm>
#include <cstdint>

namespace graze {

/// Two objects by their places in the order of addition, the lower first, as one number: numbers ascend as
/// (first, second) do.
using PlacePair = std::uint64_t;

constexpr PlacePair pair_of(std::uint32_t one, std::uint32_t other) {
  return (PlacePair{std::min(one, other)} << 32U) | std::max(one, other);
}
constexpr std::uint32_t first_of(PlacePair pair) {
  return static_cast<std::uint32_t>(pair >> 32U);
}
constexpr std::uint32_t second_of(PlacePair pair) {
  return static_cast<std::uint32_t>(pair);
}

}  // namespace graze
