#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace graze {

/// Names one object of a scene, for ever: an index that may be used again and a generation that tells the
/// users of that index apart. A default id names nothing.
struct ObjectId {
  std::uint32_t index = 0;
  std::uint32_t generation = 0;  ///< 0 in no id that a scene gives

  friend auto operator<=>(const ObjectId&, const ObjectId&) = default;
};

}  // namespace graze

/// Ids as keys of std::unordered_map and std::unordered_set.
template <>
struct std::hash<graze::ObjectId> {
  [[nodiscard]] std::size_t operator()(const graze::ObjectId& id) const noexcept {
    // One to one, and it spreads neighbouring ids over all bits: a step of the generator SplitMix64.
    std::uint64_t bits = std::uint64_t{id.generation} << 32 | id.index;
    bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ bits >> 27) * 0x94D049BB133111EBU;
    return static_cast<std::size_t>(bits ^ bits >> 31);
  }
};
