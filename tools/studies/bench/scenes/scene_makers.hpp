#pragma once

#include <string>

#include "bench/scenes/scenes.hpp"

// The scenes that are made in files of their own.
namespace graze::bench {

/// S6: overlapping boxes say nothing here.
BenchScene linked_tori();
BenchScene nested_shells();
BenchScene draped_cloth();

/// S7: a mesh of the data folder in its connected parts, each with a smooth wobble of half an edge.
BenchScene real_mesh(std::string name, std::string what, const std::string& file);

/// In S8 a heap's bodies touch, at rest or with noise. In S9 most bodies sleep. S10 has props on a landscape,
/// the whole of it or what lies under them.
BenchScene heap(bool is_noisy);
BenchScene sleepers();
BenchScene landscape(bool is_cropped);

}  // namespace graze::bench
