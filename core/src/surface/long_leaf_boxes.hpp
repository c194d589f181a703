#pragma once

#include <span>
#include <tuple>

#include "core/surface/surface.hpp"
#include "surface/per_leaf_cache.hpp"

namespace graze {

/// The present box of a leaf's features along the axes of another box.
[[nodiscard]] OrientedBox box_along(const OrientedBox& axes, const Surface& surface, std::uint32_t leaf);

/// The present boxes along the faces of one surface's long leaves, as LeafBoxes has those along the axes of
/// space.
class LongLeafBoxes {
 public:
  /// For one query. `surface` does not change meanwhile.
  void begin(const Surface& surface) {
    surface_ = surface.mesh().long_regions().empty() ? nullptr : &surface;
    if (surface_ == nullptr) return;
    const bool fitted = surface.motion_since_refit(RefitOf::faces) == 0;
    fitted_ = fitted ? surface.oriented_boxes() : std::span<const OrientedBox>();
    if (!fitted) made_.begin(surface, surface.mesh().long_regions().count());
  }
  /// Whether the surface has any.
  [[nodiscard]] bool any() const { return surface_ != nullptr; }
  /// Null for a leaf that is not long. It stays until the next `begin`.
  const OrientedBox* of(std::uint32_t leaf) {
    if (surface_ == nullptr) return nullptr;
    const LongRegions& all = surface_->mesh().long_regions();
    const std::uint32_t index = all.index_of(leaf);
    if (index == LongRegions::none) return nullptr;
    if (!fitted_.empty()) return &fitted_[index];
    return &made_.of(index, [&] { return surface_->oriented_box_now(all.all()[index]); });
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.made_);
  }
  void reserve(const PairRoom& room) { made_.reserve(room.long_regions); }

 private:
  const Surface* surface_ = nullptr;
  std::span<const OrientedBox> fitted_;
  PerLeafCache<OrientedBox> made_;
};

}  // namespace graze
