#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <graze/position_view.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "core/base/block_sizes.hpp"

namespace graze {

/// A surface's used vertices, or those of a part of it, eight at a time in the order of
/// IndexedMesh::block_order. Each such block has a box, each sixteen boxes have one again, and so on. They
/// are made anew wherever the surface moved. For vertices that costs less than a hierarchy that is kept from
/// step to step would save.
class VertexBlocks {
 public:
  static constexpr std::uint32_t block_size = vertices_per_block;  ///< vertices
  static constexpr std::uint32_t group_size = boxes_per_group;     ///< boxes
  static constexpr std::uint32_t group_vertices = vertices_per_group;
  /// Returns the number of boxes, rounded up to whole groups.
  static constexpr std::size_t in_whole_groups(std::size_t count) {
    return (count + group_size - 1) / group_size * group_size;
  }
  /// Boxes in six rows, least x, y, z and greatest, about the origin. They go up to a multiple of sixteen, of
  /// which those behind the last are NaN and meet nothing.
  struct Level {
    const float* rows = nullptr;
    std::size_t stride = 0;
    std::size_t count = 0;
  };

  /// Makes the blocks from positions that lie one beside the other. `order` is all of
  /// IndexedMesh::block_order, or whole groups of it, and is kept as a view.
  void make(std::span<const std::uint32_t> order, const PositionView& positions);
  /// Makes room for so many vertices.
  void reserve(std::size_t vertices);

  /// The point that boxes are relative to, amid most vertices.
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  /// How many levels there are. Level 0 has a box for each block, and each further level one for sixteen
  /// boxes of the level before. The last level has a few groups.
  [[nodiscard]] std::size_t level_count() const { return level_count_; }
  [[nodiscard]] Level level(std::size_t index) const;
  /// The box of one block about the origin: least x, y, z and greatest.
  [[nodiscard]] std::array<float, 6> box(std::uint32_t block) const;

  /// The vertices of a block.
  [[nodiscard]] std::span<const std::uint32_t> vertices(std::uint32_t block) const {
    const std::size_t first = std::size_t{block} * block_size;
    return order_.subspan(first, std::min<std::size_t>(block_size, order_.size() - first));
  }

  [[nodiscard]] std::size_t byte_count() const;
  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.boxes_);
  }

 private:
  template <typename Number>
  void box_blocks(const PositionView& positions);
  void lay_out_levels();
  void box_level(std::size_t level);

  /// Enough for 2^32 vertices.
  static constexpr std::size_t most_levels = 8;
  struct LevelLayout {
    std::size_t first = 0;  ///< in `boxes_`
    std::size_t stride = 0;
    std::size_t count = 0;
  };

  std::span<const std::uint32_t> order_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<float> boxes_;
  std::array<LevelLayout, most_levels> levels_;
  std::size_t level_count_ = 0;
};

}  // namespace graze
