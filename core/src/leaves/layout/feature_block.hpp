#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/working_memory.hpp"
#include "core/pair/near_list.hpp"
#include "kernels/filter.hpp"

namespace graze {

/// The features of a block by their corners as they came and by what they are part of, where these are now.
template <std::size_t Corners>
struct FeatureView {
  const kernels::Point* points;
  const std::uint32_t* owners;
  FeatureRefKind kind;

  [[nodiscard]] const kernels::Point* corners(std::size_t i) const { return points + i * Corners; }
  [[nodiscard]] FeatureRef ref_of(std::size_t i) const { return {kind, owners[i]}; }
};

/// Features of one kind as the kernels read them, of `Corners` points each.
template <std::size_t Corners>
class FeatureBlock {
 public:
  explicit FeatureBlock(FeatureRefKind kind) : kind_(kind) {}

  /// Empties it, and makes room for `most` features.
  void begin(std::size_t most) {
    stride_ = stride_of(most);
    make_room(most);
    owners_.clear();
  }

  /// Adds the feature that `owner` stands for, to be laid out.
  void add(std::uint32_t owner) { owners_.push_back(owner); }
  void add(std::span<const std::uint32_t> owners) {
    owners_.insert(owners_.end(), owners.begin(), owners.end());
  }
  /// Lays out all features that were added. `corners` has the index of each feature's corners among
  /// `vertices`, up to a multiple of 4 features.
  void lay_out(const kernels::Point* vertices, const std::uint32_t* corners) {
    const kernels::Filter& filter = kernels::filter();
    const auto kernel = Corners == 1   ? filter.lay_out_points
                        : Corners == 2 ? filter.lay_out_segments
                                       : filter.lay_out_triangles;
    kernel(vertices, corners, count(), data_.data(), stride_, points_.data());
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.data_, self.points_, self.owners_);
  }
  void reserve_as(const FeatureBlock& other) {
    make_room(other.points_.size() / Corners);
    graze::reserve_as(owners_, other.owners_);
  }
  /// Makes room. The block keeps its content.
  void reserve(std::size_t most) {
    make_room(most);
    owners_.reserve(most);
  }

  [[nodiscard]] std::size_t count() const { return owners_.size(); }
  [[nodiscard]] std::uint32_t owner(std::size_t i) const { return owners_[i]; }
  [[nodiscard]] float component(std::size_t k, std::size_t i) const { return data_[k * stride_ + i]; }
  /// The corners of a feature as they came.
  [[nodiscard]] const kernels::Point* corners(std::size_t i) const { return view().corners(i); }
  /// Until something is added or laid out.
  [[nodiscard]] FeatureView<Corners> view() const { return {points_.data(), owners_.data(), kind_}; }
  [[nodiscard]] kernels::Block block() const { return {data_.data(), stride_, owners_.size()}; }
  static std::size_t stride_of(std::size_t most) {
    return (most + kernels::lanes - 1) / kernels::lanes * kernels::lanes;
  }

 private:
  void make_room(std::size_t most) {
    const std::size_t floats = stride_of(most) * kernels::component_count<Corners>;
    const std::size_t points = stride_of(most) * Corners;
    if (data_.size() < floats) data_.resize(floats);
    if (points_.size() < points) points_.resize(points);
  }

  std::vector<float> data_;
  std::size_t stride_ = 0;
  std::vector<kernels::Point> points_;
  std::vector<std::uint32_t> owners_;
  FeatureRefKind kind_;
};

using PointBlock = FeatureBlock<1>;
using SegmentBlock = FeatureBlock<2>;
using TriangleBlock = FeatureBlock<3>;

/// Some features of a block, those first that may touch.
template <std::size_t Corners>
class SelectedFeatures {
 public:
  /// Takes those that `by` keeps, and extends `found`, where there is one, by their box. The block stays.
  void select_near(const FeatureBlock<Corners>& all, const kernels::ClipBy& by, kernels::BoxInFrame* found) {
    all_ = &all;
    count_ = touching_ = 0;
    if (all.count() == 0) return;
    make_room(all.count());
    const kernels::Filter& filter = kernels::filter();
    const auto kernel = Corners == 1   ? filter.clip_points
                        : Corners == 2 ? filter.clip_segments
                                       : filter.clip_triangles;
    const kernels::ClipCount clipped = kernel(all.block(), by, {index_.data(), others_.data(), found});
    touching_ = clipped.touching;
    count_ = clipped.touching + clipped.others;
    const auto end = std::copy_n(others_.begin(), clipped.others,
                                 index_.begin() + static_cast<std::ptrdiff_t>(clipped.touching));
    std::fill_n(end, FeatureBlock<Corners>::stride_of(count_) - count_, 0U);
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.index_, self.others_);
  }
  void reserve(std::size_t most) { make_room(most); }

  [[nodiscard]] const FeatureBlock<Corners>& all() const { return *all_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// How many of them, the first, may touch.
  [[nodiscard]] std::size_t touching() const { return touching_; }
  /// Each one's number in the block. As many more of any features follow as make a multiple of 4.
  [[nodiscard]] const std::uint32_t* index() const { return index_.data(); }

 private:
  void make_room(std::size_t most) {
    const std::size_t room = FeatureBlock<Corners>::stride_of(most) + kernels::lanes;
    if (index_.size() < room) index_.resize(room);
    if (others_.size() < room) others_.resize(room);
  }

  const FeatureBlock<Corners>* all_ = nullptr;
  std::size_t count_ = 0;
  std::size_t touching_ = 0;
  std::vector<std::uint32_t> index_;
  std::vector<std::uint32_t> others_;  ///< those that do not touch, until they are put behind the others
};

}  // namespace graze
