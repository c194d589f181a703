#pragma once

#include "bench/scenes.hpp"

namespace graze::bench {

/// The same scene in slow motion: so many frames in place of each of its own, straight from one to the next.
BenchScene in_slow_motion(BenchScene scene, std::size_t times);

}  // namespace graze::bench
