#pragma once

#include <bit>
#include <cstdint>

#include "core/mesh/region_tree.hpp"
#include "core/pair/leaf_front.hpp"

namespace graze {

/// The order in which pairs of leaves are tested for touching. It takes one leaf of the surface with fewer
/// regions after the other, scattered, and with each the leaves of the other surface by their numbers. Leaves
/// that follow one another by number are neighbours. Where boxes overlap but surfaces do not touch they would
/// all be in the way. The order depends on the two meshes alone.
class TouchingOrder {
 public:
  TouchingOrder(const RegionTree& a, const RegionTree& b)
      : scatters_a_(a.region_count() < b.region_count()),
        count_(scatters_a_ ? a.region_count() : b.region_count()),
        slot_count_(std::bit_ceil(count_)) {
    // Steps of the golden ratio of all slots. The step is odd, so that every slot gets another number.
    constexpr std::uint64_t golden = 0x9e3779b9;
    step_ = static_cast<std::uint32_t>(golden * slot_count_ >> 32U) | 1U;
    // Newton's iteration: three bits of an odd number's inverse are those of the number.
    slot_step_ = step_;
    for (int i = 0; i < 4; ++i) slot_step_ *= 2 - step_ * slot_step_;
  }

  [[nodiscard]] std::uint64_t of(const RegionPair& pair) const {
    const std::uint32_t scattered = scatters_a_ ? pair.a : pair.b;
    const std::uint32_t slot = scattered * slot_step_ & (slot_count_ - 1);
    return std::uint64_t{slot} << 32U | (scatters_a_ ? pair.b : pair.a);
  }
  /// Whether one of two that identify a pair of leaves comes before the other.
  template <typename Named>
  bool operator()(const Named& left, const Named& right) const {
    return of(left.pair) < of(right.pair);
  }
  /// How many slots regions are scattered over.
  [[nodiscard]] std::uint32_t slot_count() const { return slot_count_; }
  /// The number of the region at a slot. A slot is empty where this is not below `region_count`.
  [[nodiscard]] std::uint32_t region_at(std::uint32_t slot) const { return slot * step_ & (slot_count_ - 1); }
  [[nodiscard]] std::uint32_t region_count() const { return count_; }
  [[nodiscard]] bool scatters_a() const { return scatters_a_; }
  /// All of the other surface with a region of the one that is scattered.
  [[nodiscard]] RegionPair with_all(std::uint32_t region) const {
    return scatters_a_ ? RegionPair{region, 0} : RegionPair{0, region};
  }

 private:
  bool scatters_a_;
  std::uint32_t count_;
  std::uint32_t slot_count_;
  std::uint32_t step_ = 1;
  std::uint32_t slot_step_ = 1;
};

}  // namespace graze
