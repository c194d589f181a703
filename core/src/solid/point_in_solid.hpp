#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "arithmetic/arithmetic.hpp"
#include "closest_features/closest_features.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Says where a point is, seen from a closed surface. It is `inside_out` if it is inside, and the surface
/// winds about it as one whose normals lead inwards.
enum class PointInSolid : std::uint8_t { outside, inside, inside_out, on_surface };

/// Decides exactly where a point is. It is inside where the surface's winding number about it is not 0. The
/// surface is closed, and has been refitted for faces.
PointInSolid locate(const Eigen::Vector3d& point, const Surface& solid, DecisionCount& count);

/// Whether the normal of a triangle of a closed surface leads inwards at a point of the triangle: whether the
/// surface winds about the place in front of it more often than about the place behind it, in either sense.
/// The point may be off the triangle by rounding. The surface has been refitted for faces.
bool normal_leads_in(const Surface& solid, const FeaturePiece& triangle, const Eigen::Vector3d& point,
                     DecisionCount& count);

}  // namespace graze
