#pragma once

#include "core/surface/surface.hpp"
#include "kernels/points.hpp"

namespace graze {

/// Puts a vertex's position in a lane of a kernel's batch.
inline void put_corner(const Surface& surface, std::uint32_t vertex, kernels::Points& points,
                       std::size_t lane) {
  const Eigen::Vector3d position = surface.position(vertex);
  for (int axis = 0; axis < 3; ++axis) points[axis][lane] = position[axis];
}

}  // namespace graze
