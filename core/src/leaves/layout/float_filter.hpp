#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "arithmetic/arithmetic.hpp"
#include "arithmetic/certain.hpp"
#include "base/working_memory.hpp"
#include "core/base/box.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/surface/surface.hpp"
#include "leaves/layout/feature_block.hpp"
#include "leaves/layout/filter_frame.hpp"
#include "pair/bounds.hpp"

namespace graze {

/// The box of the corners of a feature.
Box box_of(const Surface& surface, FeatureRefKind kind, std::uint32_t index);

/// Two numbers of each pair of features that a kernel has left, with room for so many pairs or those of one
/// row.
struct FloatFilterScratch {
  static constexpr std::size_t pairs_at_once = 4096;

  std::vector<std::uint32_t> row;
  std::vector<std::uint32_t> column;
  std::vector<float> bound;
  std::vector<float> columns;  ///< components of the features that are compared with each row

  kernels::NearPairs room_for(std::size_t columns_in_row) {
    const std::size_t pairs = std::max(columns_in_row, pairs_at_once) + kernels::lanes;
    if (row.size() < pairs) {
      row.resize(pairs);
      column.resize(pairs);
    }
    return {row.data(), column.data()};
  }
  kernels::Survivors room_for_row(std::size_t columns_in_row) {
    room_for(columns_in_row);
    if (bound.size() < columns_in_row) bound.resize(columns_in_row);
    return {column.data(), bound.data()};
  }
  /// Gathers so many components, from `first` on, of the features selected from a block.
  template <std::size_t Corners>
  kernels::Block gather(const SelectedFeatures<Corners>& taken, std::size_t first, std::size_t components) {
    const std::size_t stride = FeatureBlock<Corners>::stride_of(taken.count());
    if (columns.size() < components * stride) columns.resize(components * stride);
    const kernels::Block all = taken.all().block();
    kernels::filter().gather({all.data + first * all.stride, all.stride, all.count}, components,
                             taken.index(), taken.count(), columns.data(), stride);
    return {columns.data(), stride, taken.count()};
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.row, self.column, self.bound, self.columns);
  }
  void reserve(const PairRoom& room) {
    const std::size_t most = std::max({room.leaf_vertices, room.leaf_edges, 2 * room.leaf_faces});
    room_for_row(most);
    const std::size_t floats = kernels::box_components * PointBlock::stride_of(most);
    if (columns.size() < floats) columns.resize(floats);
  }
};

/// The knowledge of float about a pair of features that it has not discarded.
struct KnownInFloat {
  bool is_bounded = false;  ///< that it may be near. Otherwise it has not been tested
  std::int32_t voronoi = kernels::unsure_voronoi;
  // The distance in the frame from below and above, of a vertex and a triangle whose Voronoi region is known.
  float lower = 0;
  float upper = 0;
};

/// The squared distance of a vertex and a triangle whose Voronoi region float knows.
inline SquaredRange squared_range(const KnownInFloat& known, const FilterFrame& frame) {
  const double lower = std::max(0.0, static_cast<double>(known.lower)) / frame.scale();
  const double upper = static_cast<double>(known.upper) / frame.scale();
  return {lower * lower * (1 - 0x1p-50) - 0x1p-1000, upper * upper * (1 + 0x1p-50) + 0x1p-1000};
}

/// Pairs of features whose distance float is to bound from below, which is done several at once.
template <std::size_t CornersA, std::size_t CornersB>
class FloatBatch {
 public:
  void begin() { count_ = 0; }

  /// Adds pairs of features by their numbers in two blocks. Calls `full()`, which empties it, whenever it is.
  template <typename Full>
  void add(const FeatureView<CornersA>& a, const std::uint32_t* of_a, const FeatureView<CornersB>& b,
           const std::uint32_t* of_b, std::size_t count, const Full& full) {
    // Views and counts by value, and pairs by the stretch: what is stored might otherwise be any of these.
    const FeatureView<CornersA> all_a = a;
    const FeatureView<CornersB> all_b = b;
    for (std::size_t done = 0; done < count;) {
      const std::size_t first = count_;
      const std::size_t some = std::min(count - done, kernels::lanes - first);
      for (std::size_t k = 0; k < some; ++k) put(first + k, all_a, of_a[done + k], all_b, of_b[done + k]);
      count_ = first + some;
      done += some;
      if (count_ == kernels::lanes) full();
    }
  }
  /// Adds a pair of features by their corners. Returns whether it is full then.
  bool add(const FeatureRef& a, const std::array<kernels::Point, CornersA>& corners_a, const FeatureRef& b,
           const std::array<kernels::Point, CornersB>& corners_b) {
    std::copy(corners_a.begin(), corners_a.end(), pairs_.a[count_]);
    std::copy(corners_b.begin(), corners_b.end(), pairs_.b[count_]);
    refs_[count_] = {a, b};
    return ++count_ == kernels::lanes;
  }
  /// Calls `visit(feature of a, feature of b)` for each pair that `ask(pairs)`, a kernel, has left.
  template <typename Ask, typename Visit>
  void ask(const Ask& ask, const Visit& visit) {
    if (count_ == 0) return;
    for (std::uint32_t left = ask(pairs_) & ((1U << count_) - 1); left != 0; left &= left - 1) {
      const auto& [a, b] = refs_[static_cast<std::size_t>(std::countr_zero(left))];
      visit(a, b);
    }
  }
  /// Empties the batch. Calls `visit(feature of a, feature of b, what is known)` for each pair that
  /// `ask(pairs)`, a kernel, has left. A pair that comes again right away, as a quad's second triangle does,
  /// is visited once. Returns how many were discarded.
  template <typename Ask, typename Visit>
  std::size_t empty(const Ask& ask, const Visit& visit) {
    const std::size_t count = std::exchange(count_, 0);
    if (count == 0) return 0;
    std::uint32_t left = ask(pairs_) & ((1U << count) - 1);
    const std::size_t discarded = count - static_cast<std::size_t>(std::popcount(left));
    for (std::size_t last = kernels::lanes; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      if (last == kernels::lanes || refs_[lane] != refs_[last])
        visit(refs_[lane].first, refs_[lane].second,
              KnownInFloat{pairs_.bound[lane] > -std::numeric_limits<float>::infinity(), pairs_.voronoi[lane],
                           pairs_.bound[lane], pairs_.upper[lane]});
      last = lane;
    }
    return discarded;
  }

 private:
  void put(std::size_t lane, const FeatureView<CornersA>& a, std::size_t i, const FeatureView<CornersB>& b,
           std::size_t j) {
    std::memcpy(pairs_.a[lane], a.corners(i), sizeof pairs_.a[lane]);
    std::memcpy(pairs_.b[lane], b.corners(j), sizeof pairs_.b[lane]);
    refs_[lane] = {a.ref_of(i), b.ref_of(j)};
  }

  kernels::FeaturePairs<CornersA, CornersB> pairs_{};
  std::array<std::pair<FeatureRef, FeatureRef>, kernels::lanes> refs_;
  std::size_t count_ = 0;
};

/// The pairs of features of two surfaces that are near by their boxes.
struct FloatBatches {
  FloatFilterScratch lists;
  FilterFrame frame;            ///< that all of them are in
  FloatBatch<1, 3> vertex_a;    ///< a vertex of a, a triangle of b
  FloatBatch<1, 3> vertex_b;    ///< a vertex of b, a triangle of a
  FloatBatch<2, 2> segments;    ///< one of a, one of b
  bool is_of_one_leaf = false;  ///< whether the segments are of one leaf with itself: each two are met twice
  FloatBatch<2, 3> through_b;   ///< a segment of a, a triangle of b
  FloatBatch<2, 3> through_a;   ///< a segment of b, a triangle of a

  /// Before the first of a query or slice.
  void begin() {
    vertex_a.begin();
    vertex_b.begin();
    segments.begin();
    is_of_one_leaf = false;
    through_b.begin();
    through_a.begin();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.lists);
  }
};

}  // namespace graze
