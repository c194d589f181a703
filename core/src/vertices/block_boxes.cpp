#include "vertices/block_boxes.hpp"

#include <limits>
#include <utility>

namespace graze {

kernels::BoxInFrame box_about(const Eigen::Vector3d& origin, const Box& box, float grown) {
  kernels::BoxInFrame about{};
  for (int axis = 0; axis < 3; ++axis) {
    about.min[axis] = static_cast<float>(box.min[axis] - origin[axis]);
    about.max[axis] = static_cast<float>(box.max[axis] - origin[axis]);
  }
  return moved(about, Eigen::Vector3f::Zero(), grown);
}

kernels::BoxInFrame around_all(const VertexBlocks& blocks, std::span<const std::uint32_t> listed) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const VertexBlocks::Level boxes = blocks.level(0);
  std::array<float, 3> low{infinity, infinity, infinity};
  std::array<float, 3> high{-infinity, -infinity, -infinity};
  for (const std::uint32_t block : listed)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], boxes.rows[axis * boxes.stride + block]);
      high[axis] = std::max(high[axis], boxes.rows[(axis + 3) * boxes.stride + block]);
    }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

kernels::Block rows_of(const VertexBlocks::Level& level) {
  return {level.rows, level.stride, level.count};
}

kernels::Block rows_of(const BoxRows& boxes) {
  return {boxes.rows.data(), boxes.stride, boxes.stride};
}

kernels::Block rows_of(const VertexStretches& stretches) {
  return {stretches.rows(), stretches.stride(), stretches.stride()};
}

void gather_boxes(const kernels::Block& from, std::span<const std::uint32_t> indices, BoxRows& boxes) {
  boxes.stride = VertexBlocks::in_whole_groups(indices.size());
  if (boxes.rows.size() < 6 * boxes.stride) boxes.rows.resize(6 * boxes.stride);
  for (std::size_t row = 0; row < 6; ++row) {
    float* const to = boxes.rows.data() + row * boxes.stride;
    const float* const of_row = from.data + row * from.stride;
    for (std::size_t i = 0; i < indices.size(); ++i) to[i] = of_row[indices[i]];
    std::fill(to + indices.size(), to + boxes.stride, std::numeric_limits<float>::quiet_NaN());
  }
}

void find_meeting(const VertexBlocks& blocks, const kernels::BoxInFrame& box, IndexList& groups,
                  IndexList& found) {
  const std::size_t top = blocks.level_count() - 1;
  const std::size_t most = blocks.level(0).stride;
  groups.room_for(most);
  found.count = kernels::filter().meeting(rows_of(blocks.level(top)), nullptr,
                                          blocks.level(top).stride / VertexBlocks::group_size, box,
                                          found.room_for(most));
  for (std::size_t level = top; level-- > 0;) {
    std::swap(groups, found);
    found.count = kernels::filter().meeting(rows_of(blocks.level(level)), groups.room.data(), groups.count,
                                            box, found.room.data());
  }
}

void find_meeting(const BoxRows& boxes, const kernels::BoxInFrame& box, IndexList& found) {
  found.count = kernels::filter().meeting(rows_of(boxes), nullptr, boxes.stride / VertexBlocks::group_size,
                                          box, found.room_for(boxes.stride));
}

}  // namespace graze
