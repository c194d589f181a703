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
  /// The pairs of corners that are left in the leaves reached, when each leaf keeps the corners within the
  /// distance of the other's box. Counted for bounds of faces only.
  std::uint64_t corner_pairs_left = 0;
  std::uint64_t near_found = 0;  ///< of those, nearer than the distance; of vertices' bounds only
  double update_ms = 0;          ///< bounds of all regions of all objects, points laid out in order included
  double walk_ms = 0;            ///< all pairs of objects
  double leaf_ms =
      0;  ///< each pair of vertices in the pairs of leaves that were reached; of vertices' bounds only
  double test_ns = 0;  ///< one test of two regions

  [[nodiscard]] double search_ms() const { return update_ms + walk_ms; }
  [[nodiscard]] double step_ms() const { return update_ms + walk_ms + leaf_ms; }
};

/// How a bound is measured.
struct MeasureSettings {
  Cover cover = Cover::vertices;
  std::uint32_t runs = 1;  ///< each time is the fastest of so many
};

/// Pairs of regions whose tests are timed, the same for all kinds of bound.
struct TimedTests {
  struct Of {
    std::uint32_t frame, object_a, object_b;
    std::vector<NodePair> pairs;
  };
  std::vector<Of> tests;
};

/// The tests that the library's boxes lead to.
TimedTests tests_of_boxes(const DividedScene& divided, const MeasureSettings& settings);

/// Plays the scene's frames.
template <typename Volume>
BoundMeasure measure_bound(const DividedScene& divided, const MeasureSettings& settings,
                           const TimedTests& timed);

}  // namespace graze::tools
