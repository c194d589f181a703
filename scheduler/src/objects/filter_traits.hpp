#pragma once

#include <cstdint>
#include <graze/settings.hpp>

namespace graze {

/// The settings of an object that decide for good which other objects it can never touch.
struct FilterTraits {
  std::uint64_t group = 0;
  std::uint32_t layer = 0;
  std::uint32_t collides_with = 0;
  bool is_fixed = false;

  friend bool operator==(const FilterTraits&, const FilterTraits&) = default;
};

inline FilterTraits filter_traits_of(const ObjectSettings& settings) {
  return {settings.group, settings.layer, settings.collides_with, settings.motion == Motion::fixed};
}

/// The filter that leaves a pair out. If several do, it is the first in this order.
enum class PairVerdict : std::uint8_t {
  tested,
  fixed,    ///< both are fixed
  layer,    ///< one's layer is not in the other's mask
  group,    ///< both are in one group
  ignored,  ///< by Scene::ignore, as a whole or all groups of its faces
};

/// The verdict of the filters that never change: any but `ignored`.
inline PairVerdict lasting_verdict(const FilterTraits& a, const FilterTraits& b) {
  if (a.is_fixed && b.is_fixed) return PairVerdict::fixed;
  if ((a.layer & b.collides_with) == 0 || (b.layer & a.collides_with) == 0) return PairVerdict::layer;
  if (a.group != 0 && a.group == b.group) return PairVerdict::group;
  return PairVerdict::tested;
}

}  // namespace graze
