#pragma once

#include "examples/loops/shape.hpp"

namespace loops {

/// Half the width of the square that the terrain covers, in metres.
constexpr double terrain_half_width = 32;

/// Returns the height of the ground, in metres. It rises at the border, so that nothing rolls off.
double ground_height(double x, double y);

/// Returns the ground as a closed block, so that it has an inside. What a fast object drives into the ground
/// then has a way out, which an open sheet would not know.
Shape terrain();

}  // namespace loops
