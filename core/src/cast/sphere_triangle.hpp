#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "arithmetic/arithmetic.hpp"
#include "core/cast/sphere_cast.hpp"

namespace graze {

/// A lower bound of the first time at which a moving sphere touches a triangle. Returns nothing where double
/// is certain that it never does, or only after `limit`.
std::optional<double> touch_time(const SphereSweep& sweep, const std::array<Eigen::Vector3d, 3>& corner,
                                 double limit);

/// Whether a moving sphere ever touches a triangle. Decided exactly.
bool ever_touches(const SphereSweep& sweep, const std::array<Eigen::Vector3d, 3>& corner,
                  DecisionCount& count);

}  // namespace graze
