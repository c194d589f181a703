#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/regions/bound_walk.hpp"
#include "experiment/regions/divided_scene.hpp"

namespace graze::tools {

/// The measurements of one kind of bound over one partition in the frames of a scene. Counts and times are
/// sums over all frames.
struct BoundMeasure {
  std::string bound;
  std::uint64_t bytes_a_region = 0;  ///< of the bound
  std::uint64_t regions = 0;
  WalkCounts walked;
  std::uint64_t leaf_vertex_pairs = 0;  ///< in the pairs of leaves that were reached
  std::vector<std::uint64_t> leaf_vertex_pairs_by_frame;
  std::uint64_t near_found = 0;  ///< of those, nearer than the distance
  double update_ms = 0;          ///< bounds of all regions of all objects, points laid out in order included
  double walk_ms = 0;            ///< all pairs of objects
  double leaf_ms = 0;            ///< each pair of vertices in the pairs of leaves that were reached

  [[nodiscard]] double step_ms() const { return update_ms + walk_ms + leaf_ms; }
};

/// Plays the scene's frames. Each time is the fastest of so many runs.
template <typename Volume>
BoundMeasure measure_bound(const DividedScene& divided, std::uint32_t runs);

}  // namespace graze::tools
