#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

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

/// Of an object that is gone, and of a pair of which one is.
constexpr std::uint32_t no_place = ~std::uint32_t{0};
constexpr PlacePair no_pair = ~PlacePair{0};

/// A pair by the places that its objects have after they moved from each place to that in `moves`; no_pair
/// where one is gone. Objects keep their order, and so do their pairs.
inline PlacePair moved_pair(PlacePair pair, std::span<const std::uint32_t> moves) {
  const std::uint32_t first = moves[first_of(pair)];
  const std::uint32_t second = moves[second_of(pair)];
  return first == no_place || second == no_place ? no_pair : pair_of(first, second);
}

}  // namespace graze
