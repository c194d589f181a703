#include "core/surface/vertex_blocks.hpp"

#include <algorithm>
#include <limits>

#include "base/middle_of_three.hpp"
#include "core/base/bytes_of.hpp"
#include "surface/passes_for.hpp"

namespace graze {
namespace {

static_assert(VertexBlocks::block_size == kernels::block_size);

/// A level of so many groups is tested as quickly as another level would be made.
constexpr std::size_t most_groups_to_scan = 8;

}  // namespace

void VertexBlocks::make(std::span<const std::uint32_t> order, const PositionView& positions) {
  order_ = order;
  origin_ = order.empty() ? Eigen::Vector3d::Zero()
                          : middle_of_three(positions[order.front()], positions[order[order.size() / 2]],
                                            positions[order.back()]);
  lay_out_levels();
  positions.is_double() ? box_blocks<double>(positions) : box_blocks<float>(positions);
  for (std::size_t level = 1; level < level_count_; ++level) box_level(level);
}

template <typename Number>
void VertexBlocks::box_blocks(const PositionView& positions) {
  const Eigen::Matrix<Number, 3, 1> about = origin_.cast<Number>();  // exact: it is one of their coordinates
  passes_for<Number>().box_blocks(points_of<Number>(positions), order_.data(), order_.size(), about.data(),
                                  boxes_.data(), levels_[0].stride);
}

/// Boxes behind the last of a level stay NaN, so that they meet nothing, not even an infinite box. They are
/// made so once, when the number of blocks changes.
void VertexBlocks::lay_out_levels() {
  std::size_t count = (order_.size() + block_size - 1) / block_size;
  if (level_count_ > 0 && levels_[0].count == count) return;
  level_count_ = 0;
  std::size_t first = 0;
  while (true) {
    const std::size_t stride = in_whole_groups(count);
    levels_[level_count_++] = {first, stride, count};
    first += 6 * stride;
    if (stride / group_size <= most_groups_to_scan) break;
    count = stride / group_size;
  }
  boxes_.assign(first, std::numeric_limits<float>::quiet_NaN());
}

void VertexBlocks::reserve(std::size_t vertices) {
  std::size_t floats = 0;
  for (std::size_t count = vertices / block_size + 1; count > 1; count = count / group_size + 1)
    floats += 6 * in_whole_groups(count);
  boxes_.reserve(floats);
}

/// A group's first box is there, so that one that is not is never the least or the greatest.
void VertexBlocks::box_level(std::size_t level) {
  const LevelLayout& below = levels_[level - 1];
  const LevelLayout& layout = levels_[level];
  for (std::size_t row = 0; row < 6; ++row) {
    const float* const from = boxes_.data() + below.first + row * below.stride;
    float* const to = boxes_.data() + layout.first + row * layout.stride;
    for (std::size_t i = 0; i < layout.count; ++i) {
      const std::span<const float> group(from + i * group_size, group_size);
      to[i] = row < 3 ? *std::min_element(group.begin(), group.end())
                      : *std::max_element(group.begin(), group.end());
    }
  }
}

VertexBlocks::Level VertexBlocks::level(std::size_t index) const {
  const LevelLayout& layout = levels_[index];
  return {boxes_.data() + layout.first, layout.stride, layout.count};
}

std::array<float, 6> VertexBlocks::box(std::uint32_t block) const {
  std::array<float, 6> box;
  for (std::size_t row = 0; row < 6; ++row) box[row] = boxes_[row * levels_[0].stride + block];
  return box;
}

std::size_t VertexBlocks::byte_count() const {
  return bytes_of(boxes_);
}

}  // namespace graze
