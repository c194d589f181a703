#include "core/surface/vertex_stretches.hpp"

#include <array>
#include <limits>

#include "base/middle_of_three.hpp"
#include "core/base/bytes_of.hpp"
#include "core/surface/vertex_blocks.hpp"
#include "surface/passes_for.hpp"

namespace graze {
namespace {

static_assert(VertexStretches::stretch_size == kernels::stretch_size);

template <typename Number>
void box_stretches(const PositionView& positions, const Eigen::Vector3d& origin, float* boxes,
                   std::size_t stride) {
  // Exact: it is one of their coordinates.
  const std::array<Number, 3> about{static_cast<Number>(origin.x()), static_cast<Number>(origin.y()),
                                    static_cast<Number>(origin.z())};
  passes_for<Number>().box_stretches(static_cast<const Number*>(positions.data()), positions.size(),
                                     about.data(), boxes, stride);
}

}  // namespace

void VertexStretches::make(const PositionView& positions) {
  const std::size_t count = positions.size();
  const std::size_t stride = VertexBlocks::in_whole_groups((count + stretch_size - 1) / stretch_size);
  if (stride != stride_) {
    stride_ = stride;
    boxes_.assign(6 * stride, std::numeric_limits<float>::quiet_NaN());
  }
  origin_ = middle_of_three(positions[0], positions[count / 2], positions[count - 1]);
  positions.is_double() ? box_stretches<double>(positions, origin_, boxes_.data(), stride)
                        : box_stretches<float>(positions, origin_, boxes_.data(), stride);
}

std::size_t VertexStretches::byte_count() const {
  return bytes_of(boxes_);
}

}  // namespace graze
