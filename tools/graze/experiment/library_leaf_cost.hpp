#pragma once

#include <cstdint>

#include "experiment/placed_frames.hpp"

namespace graze::tools {

/// What graze itself takes to look into a pair of leaves for all contacts between features, in µs on one
/// thread: a step's work on pairs of objects, over the pairs of leaves that it looked into. Of all frames
/// together, each in its fastest run.
double library_leaf_us(const PlacedFrames& scene, std::uint32_t runs);

}  // namespace graze::tools
