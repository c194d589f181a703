#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace graze {

/// @addtogroup scene
/// @{

/// Names one object of a scene. A scene never gives the same id twice, so an id stays valid as a key after
/// its object is removed. A default-constructed id names no object. `std::hash` is defined for ids, so they
/// can be keys of `std::unordered_map`.
struct ObjectId {
  /// The slot of the object in its scene. A later object may use the slot of a removed one.
  std::uint32_t index = 0;
  /// Tells objects apart that use one slot after each other. It is 0 in no id that a scene gives.
  std::uint32_t generation = 0;

  /// Compares by index, then by generation. The order has no further meaning.
  friend auto operator<=>(const ObjectId&, const ObjectId&) = default;
};

/// @}

}  // namespace graze

/// @cond
/// Makes ids usable as keys of `std::unordered_map` and `std::unordered_set`.
template <>
struct std::hash<graze::ObjectId> {
  /// Returns the hash of an id. Different ids have different hashes where `std::size_t` has 64 bits.
  [[nodiscard]] std::size_t operator()(const graze::ObjectId& id) const noexcept {
    // A step of the generator SplitMix64: it is one to one, and it spreads neighbouring ids over all bits.
    std::uint64_t bits = std::uint64_t{id.generation} << 32 | id.index;
    bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ bits >> 27) * 0x94D049BB133111EBU;
    return static_cast<std::size_t>(bits ^ bits >> 31);
  }
};
/// @endcond
