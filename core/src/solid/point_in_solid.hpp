#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "arithmetic/arithmetic.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Says where a point is, seen from a closed surface.
enum class PointInSolid : std::uint8_t { outside, inside, on_surface };

/// Decides exactly where a point is. It is inside where the surface's winding number about it is not 0. The
/// surface is closed, and has been refitted for faces.
PointInSolid locate(const Eigen::Vector3d& point, const Surface& solid, DecisionCount& count);

}  // namespace graze
