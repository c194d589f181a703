#pragma once

#include <cstdint>
#include <graze/settings.hpp>

#include "base/pair_place.hpp"

namespace graze {

/// What decides for good which other objects an object can never touch.
struct FilterTraits {
  std::uint64_t group = 0;
  std::uint32_t layer = 0;
  std::uint32_t collides_with = 0;
  bool is_fixed = false;
  PairPlace place;

  friend bool operator==(const FilterTraits&, const FilterTraits&) = default;
};

/// What leaves a pair out. If several things do, it is the first in this order, but `elsewhere` comes before
/// `ignored`.
enum class PairVerdict : std::uint8_t {
  tested,
  fixed,      ///< both are fixed
  layer,      ///< one's layer is not in the other's mask
  group,      ///< both are in one group
  ignored,    ///< by Scene::ignore, as a whole or all groups of its faces
  elsewhere,  ///< another process tests it
};

/// The verdict of the filters that never change: any but `ignored`.
inline PairVerdict lasting_verdict(const FilterTraits& a, const FilterTraits& b) {
  if (a.is_fixed && b.is_fixed) return PairVerdict::fixed;
  if ((a.layer & b.collides_with) == 0 || (b.layer & a.collides_with) == 0) return PairVerdict::layer;
  if (a.group != 0 && a.group == b.group) return PairVerdict::group;
  if ((a.place.offers & b.place.seeks) == 0 && (b.place.offers & a.place.seeks) == 0)
    return PairVerdict::elsewhere;
  return PairVerdict::tested;
}

}  // namespace graze
