#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "core/base/box.hpp"
#include "core/surface/vertex_blocks.hpp"
#include "core/surface/vertex_stretches.hpp"
#include "kernels/filter.hpp"

namespace graze {

// Boxes of blocks in float, each about the origin of its surface's blocks: which of two surfaces' are near
// each other. None that is near is missed, whatever is rounded.

/// Numbers that a kernel lists, in memory that is longer than they are many.
struct IndexList {
  std::vector<std::uint32_t> room;
  std::size_t count = 0;

  /// Room for so many, and what a kernel writes beyond the last.
  std::uint32_t* room_for(std::size_t most) {
    if (room.size() < most + kernels::lanes) room.resize(most + kernels::lanes);
    return room.data();
  }
  [[nodiscard]] std::span<const std::uint32_t> listed() const { return std::span(room).first(count); }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.room);
  }
  void reserve_as(const IndexList& other) { room.resize(std::max(room.size(), other.room.size())); }
  void reserve(std::size_t most) { room_for(most); }
};

/// Boxes in six rows, up to a multiple of sixteen, of which those behind the last are NaN and meet nothing.
struct BoxRows {
  std::vector<float> rows;
  std::size_t stride = 0;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.rows);
  }
  void reserve_as(const BoxRows& other) { rows.resize(std::max(rows.size(), other.rows.size())); }
  void reserve(std::size_t most) { rows.resize(std::max(rows.size(), 6 * most)); }
};

/// How much nearer boxes of blocks may seem in float, relative to their coordinates. The bound is half a unit
/// of 2^-23 for each of these: two coordinates about their origins, their offset, the reach, and three sums
/// of them. A coordinate that is far from those it is compared with may lose more, and is as far on.
inline constexpr float box_margin = 0x1p-20F;
/// The loss of small numbers in float.
inline constexpr float box_lost = 0x1p-140F;

inline kernels::BoxInFrame in_frame(const std::array<float, 6>& box) {
  return {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
}

/// Moves a box by `by` and grows it, so that boxes elsewhere can be compared with it.
inline kernels::BoxInFrame moved(const kernels::BoxInFrame& box, const Eigen::Vector3f& by, float grown) {
  kernels::BoxInFrame moved{};
  for (int axis = 0; axis < 3; ++axis) {
    const float away = std::abs(by[axis]) + grown;
    moved.min[axis] =
        box.min[axis] + by[axis] - (grown + (std::abs(box.min[axis]) + away) * box_margin + box_lost);
    moved.max[axis] =
        box.max[axis] + by[axis] + (grown + (std::abs(box.max[axis]) + away) * box_margin + box_lost);
  }
  return moved;
}

/// A surface's box about the origin of another's boxes, grown.
kernels::BoxInFrame box_about(const Eigen::Vector3d& origin, const Box& box, float grown);
/// The box of some blocks about their origin.
kernels::BoxInFrame around_all(const VertexBlocks& blocks, std::span<const std::uint32_t> listed);

/// At most how far a box is from one that was moved to be beside it.
inline double lower_distance(const std::array<float, 6>& box, const kernels::BoxInFrame& other) {
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0F, box[axis] - other.max[axis], other.min[axis] - box[axis + 3]});
    squared += gap * gap;
  }
  return std::sqrt(squared) * (1 - double{box_margin});
}

kernels::Block rows_of(const VertexBlocks::Level& level);
kernels::Block rows_of(const BoxRows& boxes);
kernels::Block rows_of(const VertexStretches& stretches);
/// Gathers the boxes with some indices, side by side.
void gather_boxes(const kernels::Block& from, std::span<const std::uint32_t> indices, BoxRows& boxes);
/// The blocks whose boxes meet another one, ascending: level by level, from the last down. There is room for
/// all in both lists, whatever is found, so that the same surfaces never take more.
void find_meeting(const VertexBlocks& blocks, const kernels::BoxInFrame& box, IndexList& groups,
                  IndexList& found);
/// Lists the indices of those boxes that meet another one.
void find_meeting(const BoxRows& boxes, const kernels::BoxInFrame& box, IndexList& found);

}  // namespace graze
