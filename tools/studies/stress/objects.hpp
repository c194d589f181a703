#pragma once

#include <cstddef>
#include <vector>

#include "stress/result.hpp"

namespace graze::tools {

struct ObjectsOptions {
  std::vector<std::size_t> counts;
  std::size_t frames = 0;  ///< 0: more of smaller scenes
};

/// Steps scenes of so many objects at the same density. Shows time and memory of a step and how they grow,
/// and what is left serial. Shows what a second thread brings for many small pairs and for one large pair.
/// Compares all of it with the aims. Checks that one and two threads report the same bits.
StressResult run_objects_study(const ObjectsOptions& options);

}  // namespace graze::tools
