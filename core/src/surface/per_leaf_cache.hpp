#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/working_memory.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// A cache of one value for each leaf of one surface where it is now. Values are made when asked for, since a
/// query reads few leaves of a large surface.
template <typename Value>
class PerLeafCache {
 public:
  /// Begins a query. Values that were made from the same positions are kept.
  void begin(const Surface& surface) { begin(surface, surface.mesh().regions().region_count()); }
  /// With a number of its own for each of `count` leaves.
  void begin(const Surface& surface, std::size_t count) {
    if (serial_ == surface.serial() && version_ == surface.version()) return;
    serial_ = surface.serial();
    version_ = surface.version();
    if (values_.size() < count) {
      values_.resize(count);
      made_in_.resize(count, 0);
    }
    forget();
  }
  /// Begins anew with the same positions.
  void forget() {
    if (++query_ == 0) {  // after 2^32 queries
      std::fill(made_in_.begin(), made_in_.end(), 0);
      query_ = 1;
    }
  }
  /// Returns the value of a leaf by its number, and makes it if need be. The reference stays valid until
  /// another surface or other positions.
  template <typename Make>
  const Value& of(std::size_t leaf, const Make& make) {
    if (made_in_[leaf] != query_) {
      made_in_[leaf] = query_;
      values_[leaf] = make();
    }
    return values_[leaf];
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.values_, self.made_in_);
  }
  void reserve(const PairRoom& room) { reserve(room.regions); }
  void reserve(std::size_t count) {
    values_.reserve(count);
    made_in_.reserve(count);
  }

 private:
  std::uint64_t serial_ = 0;  ///< of the surface and the positions that the values are of
  std::uint64_t version_ = 0;
  std::vector<Value> values_;
  std::vector<std::uint32_t> made_in_;  ///< in which query the value was made
  std::uint32_t query_ = 0;
};

}  // namespace graze
