#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <graze/position_view.hpp>
#include <vector>

#include "core/base/block_sizes.hpp"

namespace graze {

/// Boxes of a surface's vertices as they lie in memory, 64 each. They tell which vertices may be near another
/// surface, for less than the blocks of all its vertices cost (docs/method.md, section 2).
class VertexStretches {
 public:
  static constexpr std::uint32_t stretch_size = vertices_per_stretch;  ///< vertices

  /// Makes the stretches from positions that lie one beside the other.
  void make(const PositionView& positions);

  /// The point that boxes are relative to, amid most vertices.
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  /// Boxes as VertexBlocks::Level has them.
  [[nodiscard]] const float* rows() const { return boxes_.data(); }
  [[nodiscard]] std::size_t stride() const { return stride_; }

  [[nodiscard]] std::size_t byte_count() const;

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<float> boxes_;
  std::size_t stride_ = 0;
};

}  // namespace graze
