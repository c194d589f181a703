#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/filter.hpp"
#include "working_memory.hpp"

namespace graze {

/// What a feature of a block is part of.
enum class Part : std::uint8_t { vertex, edge, face, fold };

/// Features of one kind as the kernels read them: `Corners` points each, of `Components` numbers in all.
template <std::size_t Corners, std::size_t Components>
class FeatureBlock {
 public:
  explicit FeatureBlock(Part part) : part_(part) {}

  /// Empties it, and makes room for `most` features.
  void begin(std::size_t most) {
    stride_ = stride_of(most);
    if (data_.size() < stride_ * Components) data_.resize(stride_ * Components);
    owners_.clear();
    owner_count_ = 0;
  }

  /// Adds the feature that `owner` stands for, to be laid out.
  void add(std::uint32_t owner) {
    if (owners_.empty() || owners_.back() != owner) ++owner_count_;
    owners_.push_back(owner);
  }
  /// Adds one for each of `owners`, which are all different.
  void add(std::span<const std::uint32_t> owners) {
    owners_.insert(owners_.end(), owners.begin(), owners.end());
    owner_count_ += owners.size();
  }
  /// Lays out all that were added; `corners` are the places among `vertices` of each one's corners, up to a
  /// multiple of 4 features. What the kernels prepare is left open.
  void lay_out(const kernels::Point* vertices, const std::uint32_t* corners) {
    const kernels::Filter& filter = kernels::filter();
    const auto kernel = Corners == 1   ? filter.lay_out_points
                        : Corners == 2 ? filter.lay_out_segments
                                       : filter.lay_out_triangles;
    kernel(vertices, corners, count(), data_.data(), stride_);
  }
  /// Makes the rest.
  void prepare() {
    if constexpr (Corners == 2) kernels::filter().prepare_segments(data_.data(), stride_, count());
    if constexpr (Corners == 3) kernels::filter().prepare_triangles(data_.data(), stride_, count());
  }

  /// Extends `found` by the box of those features that `by` keeps.
  void find_near(kernels::Filter::Clip kernel, const kernels::ClipBy& by, kernels::BoxInFrame& found) const {
    if (count() > 0) kernel(block(), by, {nullptr, nullptr, &found});
  }
  /// Takes those features of another block that `by` keeps, those first that may touch, and prepares them.
  /// Extends `found`, where there is one, by their box.
  void take(const FeatureBlock& all, kernels::Filter::Clip kernel, const kernels::ClipBy& by,
            kernels::BoxInFrame* found) {
    begin(all.count());
    touching_ = 0;
    if (all.count() == 0) return;
    if (index_.size() < stride_) {
      index_.resize(stride_);
      others_.resize(stride_);
    }
    const kernels::ClipCount clipped = kernel(all.block(), by, {index_.data(), others_.data(), found});
    touching_ = clipped.touching;
    const std::size_t count = clipped.touching + clipped.others;
    const auto end = std::copy_n(others_.begin(), clipped.others,
                                 index_.begin() + static_cast<std::ptrdiff_t>(clipped.touching));
    std::fill_n(end, stride_of(count) - count, 0U);
    for (std::size_t i = 0; i < count; ++i) add(all.owners_[index_[i]]);
    constexpr std::size_t laid_out = Corners == 1   ? kernels::point::laid_out
                                     : Corners == 2 ? kernels::segment::laid_out
                                                    : kernels::triangle::laid_out;
    kernels::filter().gather(all.block(), laid_out, index_.data(), count, data_.data(), stride_);
    prepare();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.data_, self.owners_, self.index_, self.others_);
  }
  void reserve_as(const FeatureBlock& other) {
    if (data_.size() < other.data_.size()) data_.resize(other.data_.size());
    graze::reserve_as(owners_, other.owners_);
    graze::reserve_as(index_, other.index_);
    graze::reserve_as(others_, other.others_);
  }
  /// What it holds stays.
  void reserve(std::size_t most) {
    if (data_.size() < stride_of(most) * Components) data_.resize(stride_of(most) * Components);
    owners_.reserve(most);
    index_.reserve(stride_of(most));
    others_.reserve(stride_of(most));
  }

  [[nodiscard]] Part part() const { return part_; }
  [[nodiscard]] std::size_t count() const { return owners_.size(); }
  /// Features of one owner, such as a quad's triangles, are added one after the other and count once here.
  [[nodiscard]] std::size_t owner_count() const { return owner_count_; }
  [[nodiscard]] std::uint32_t owner(std::size_t i) const { return owners_[i]; }
  /// Of features taken: how many of them, the first, may touch.
  [[nodiscard]] std::size_t touching() const { return touching_; }
  [[nodiscard]] float component(std::size_t k, std::size_t i) const { return data_[k * stride_ + i]; }
  [[nodiscard]] kernels::Block block() const { return {data_.data(), stride_, owners_.size()}; }
  [[nodiscard]] kernels::Block touching_block() const { return {data_.data(), stride_, touching_}; }

 private:
  static std::size_t stride_of(std::size_t most) {
    return (most + kernels::lanes - 1) / kernels::lanes * kernels::lanes;
  }

  std::vector<float> data_;
  std::size_t stride_ = 0;
  std::vector<std::uint32_t> owners_;
  std::vector<std::uint32_t> index_;   ///< of features taken, in the block they are from
  std::vector<std::uint32_t> others_;  ///< of them, that do not touch
  std::size_t touching_ = 0;
  std::size_t owner_count_ = 0;
  Part part_;
};

using PointBlock = FeatureBlock<1, kernels::point::count>;
using SegmentBlock = FeatureBlock<2, kernels::segment::count>;
using TriangleBlock = FeatureBlock<3, kernels::triangle::count>;

/// One feature by itself.
inline kernels::Point row_of(const PointBlock& block, std::size_t i) {
  return {{block.component(0, i), block.component(1, i), block.component(2, i)}, block.component(3, i)};
}
inline kernels::Segment row_of(const SegmentBlock& block, std::size_t i) {
  return {{block.component(0, i), block.component(1, i), block.component(2, i)},
          {block.component(3, i), block.component(4, i), block.component(5, i)},
          block.component(6, i)};
}

}  // namespace graze
