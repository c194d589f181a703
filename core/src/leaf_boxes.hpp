#pragma once

#include <algorithm>
#include <cstdint>
#include <graze/surface.hpp>
#include <span>
#include <vector>

#include "working_memory.hpp"

namespace graze {

/// The boxes of one surface's leaves where it is now: those of its refit where that is of now, otherwise made
/// here when asked for. A query reads few leaves of a large surface, so they are not worth a refit of all.
class LeafBoxes {
 public:
  /// For one query; `surface` does not change meanwhile. What was made for a query about the same positions
  /// is kept.
  void begin(const Surface& surface, RefitOf what) {
    surface_ = &surface;
    const bool fitted = surface.motion_since_refit(what) == 0;
    fitted_ = {};
    if (fitted) fitted_ = surface.boxes(what);
    const bool same = serial_ == surface.serial() && version_ == surface.version() && what_ == what;
    if (fitted || same) return;
    serial_ = surface.serial();
    version_ = surface.version();
    what_ = what;
    const std::size_t count = surface.mesh().regions().regions().size();
    if (boxes_.size() < count) {
      boxes_.resize(count);
      made_in_.resize(count, 0);
    }
    if (++query_ == 0) {  // after 2^32 queries
      std::fill(made_in_.begin(), made_in_.end(), 0);
      query_ = 1;
    }
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.boxes_, self.made_in_);
  }
  void reserve(const PairRoom& room) {
    boxes_.reserve(room.regions);
    made_in_.reserve(room.regions);
  }

  /// Stays until the next `begin`.
  const Box& of(std::uint32_t leaf) {
    if (!fitted_.empty()) return fitted_[leaf];
    if (made_in_[leaf] != query_) {
      made_in_[leaf] = query_;
      const Region& region = surface_->mesh().regions().region(leaf);
      boxes_[leaf] = surface_->box_now(region, what_);
    }
    return boxes_[leaf];
  }

 private:
  const Surface* surface_ = nullptr;
  RefitOf what_ = RefitOf::faces;
  std::span<const Box> fitted_;
  std::uint64_t serial_ = 0;  ///< of the surface and the positions that the boxes are of
  std::uint64_t version_ = 0;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> made_in_;  ///< in which query the box was made
  std::uint32_t query_ = 0;
};

}  // namespace graze
