#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/scenes/scenes.hpp"
#include "experiment/recorded_motion.hpp"

// Motions that partitions are compared on, each the same in every run.
namespace graze::tools {

/// A recorded motion. Thresholds are `edges` mean edge lengths.
bench::BenchScene scene_of(const RecordedMotion& motion, std::string what, double edges);

/// The paper's five models, which meet in the middle (`graze_studies accuracy` plays them), within a mean
/// edge length.
bench::BenchScene meeting_models(std::uint64_t seed);

/// Two sheets of 121 x 61 vertices, one on the other. They rest as an accordion, its layers nearer than
/// regions are wide, and unfold. Or they rest flat and fold up the same way.
bench::BenchScene unfolding_sheets();
bench::BenchScene folding_sheets();

/// Four of the paper's humans on a skeleton, who stride in a crowd.
bench::BenchScene striding_humans();

/// Six linked tori of 4,000 vertices that turn and shift without deforming.
bench::BenchScene rigid_tori();

/// Two of one animal of the data folder's poses, one beside the other: an open surface of a wolf.
bench::BenchScene posing_wolves(const std::string& data);

}  // namespace graze::tools
