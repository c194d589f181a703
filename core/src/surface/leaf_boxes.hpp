#pragma once

#include <span>
#include <tuple>

#include "core/surface/surface.hpp"
#include "surface/per_leaf_cache.hpp"

namespace graze {

/// The present boxes of one surface's leaves. They are those of its refit if that is of now. Otherwise they
/// are made here when asked for, rather than by a refit of all.
class LeafBoxes {
 public:
  /// For one query. `surface` does not change meanwhile.
  void begin(const Surface& surface, RefitOf what) {
    surface_ = &surface;
    const bool fitted = surface.motion_since_refit(what) == 0;
    fitted_ = {};
    if (fitted) {
      fitted_ = surface.boxes(what);
      return;
    }
    made_.begin(surface);
    if (what_ != what) made_.forget();
    what_ = what;
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.made_);
  }

  /// Stays until the next `begin`.
  const Box& of(std::uint32_t leaf) {
    if (!fitted_.empty()) return fitted_[leaf];
    return made_.of(leaf, [&] { return surface_->box_now(surface_->mesh().regions().region(leaf), what_); });
  }

 private:
  const Surface* surface_ = nullptr;
  RefitOf what_ = RefitOf::faces;
  std::span<const Box> fitted_;
  PerLeafCache<Box> made_;
};

}  // namespace graze
