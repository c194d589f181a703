#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/working_memory.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/surface/surface.hpp"
#include "kernels/filter.hpp"
#include "leaves/layout/filter_frame.hpp"

namespace graze {

/// The corners of features as indices of vertices, one feature after the other.
class CornerList {
 public:
  void begin(std::size_t most) {
    count_ = 0;
    if (local_indices_.size() < most + padding) local_indices_.resize(most + padding);
  }
  void add(std::uint32_t local_index) { local_indices_[count_++] = local_index; }
  /// Returns the list, padded for the features that the kernels read behind the last.
  [[nodiscard]] const std::uint32_t* padded() {
    std::fill_n(local_indices_.begin() + static_cast<std::ptrdiff_t>(count_), padding, 0U);
    return local_indices_.data();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.local_indices_);
  }
  void reserve_as(const CornerList& other) {
    begin(std::max(other.local_indices_.size(), padding) - padding);
  }
  void reserve(std::size_t most) { begin(most); }

 private:
  static constexpr std::size_t padding = 9;  ///< three triangles
  std::vector<std::uint32_t> local_indices_;
  std::size_t count_ = 0;
};

/// The corners of a leaf's features, each converted to the frame once, however many features share it. Their
/// order is that of RegionTree.
class LeafVertices {
 public:
  /// Takes up those of a leaf, its own vertices first.
  void load(const Surface& surface, const Region& leaf, const FilterFrame& frame);
  /// Its own vertices alone.
  void load_own(const Surface& surface, const Region& leaf, const FilterFrame& frame);

  [[nodiscard]] const kernels::Point* data() const { return local_.data(); }

  /// For what the tree has no list of.
  CornerList corners;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.local_, self.corners);
  }
  void reserve(const PairRoom& room);

 private:
  void add(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame);

  std::vector<kernels::Point> local_;
};

}  // namespace graze
