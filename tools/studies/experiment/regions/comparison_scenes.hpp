#pragma once

#include <string>
#include <vector>

#include "bench/scenes/scenes.hpp"
#include "experiment/options.hpp"
#include "experiment/study.hpp"
#include "progress.hpp"

namespace graze::tools {

/// The scenes that a comparison plays, and a sentence about those that it does not.
struct ComparisonScenes {
  std::vector<bench::BenchScene> scenes;
  std::string left_out;  ///< empty, or ends with a full stop
};

/// The scenes in which partitions are compared: rigid motion, folding and unfolding, limbs, real meshes and
/// large generated ones. With fewer frames than usual (ExperimentOptions::frames) the large ones are left
/// out.
ComparisonScenes partition_scenes(const ExperimentOptions& options);

/// How many frames of each are looked at.
std::size_t compared_frames(const ExperimentOptions& options);

/// `of_all_frames` for one of `frames`.
double a_frame(std::uint64_t of_all_frames, std::size_t frames);

/// `measure(scene)` of every scene, with a progress line.
template <typename Measure>
auto measure_each(const ComparisonScenes& scenes, const Measure& measure) {
  std::vector<decltype(measure(scenes.scenes.front()))> results;
  Progress progress("scene", scenes.scenes.size());
  for (const bench::BenchScene& scene : scenes.scenes) {
    progress.at(results.size());
    results.push_back(measure(scene));
  }
  return results;
}

/// The `n`th root of the product of n positive numbers, or 1 of none.
double geometric_mean(const std::vector<double>& values);

/// One figure as a part of another. A count of 0 is taken as 1.
double beside(double mine, double other);
double beside(std::uint64_t mine, std::uint64_t other);

}  // namespace graze::tools
