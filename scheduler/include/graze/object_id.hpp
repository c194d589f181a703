#pragma once

#include <compare>
#include <cstdint>

namespace graze {

/// Names one object of a scene, for ever: an index that may be used again and a generation that tells the
/// users of that index apart. A default id names nothing.
struct ObjectId {
  std::uint32_t index = 0;
  std::uint32_t generation = 0;  ///< 0 in no id that a scene gives

  friend auto operator<=>(const ObjectId&, const ObjectId&) = default;
};

}  // namespace graze
