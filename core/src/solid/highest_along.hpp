#pragma once

#include <Eigen/Core>

#include "core/surface/surface.hpp"

namespace graze {

/// The largest product of a used vertex and a direction, as double rounds each product. The surface has been
/// refitted for faces. Boxes leave out nearly all vertices.
double highest_along(const Surface& surface, const Eigen::Vector3d& direction);

}  // namespace graze
