#pragma once

#include "bench/scenes/scenes.hpp"

namespace graze::bench {

/// Returns the scene in slow motion: `times` frames replace each frame, and positions move straight from one
/// frame to the next.
BenchScene in_slow_motion(BenchScene scene, std::size_t times);

}  // namespace graze::bench
