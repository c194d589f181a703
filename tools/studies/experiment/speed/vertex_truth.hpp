#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/modes.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// How exact mode compared with every vertex of one object against every vertex of the other.
struct VertexTruth {
  std::uint64_t pairs = 0;     ///< of objects, in the frames looked at
  std::uint64_t contacts = 0;  ///< of those, by brute force
  std::uint64_t ties = 0;      ///< of vertices, too close to the contact distance for doubles to decide
  std::uint64_t wrong = 0;     ///< pairs of objects with another set of contacts, or another distance
};

/// Looks at `frames` of the frames, evenly spread with the last among them.
VertexTruth check_vertex_truth(const RecordedMotion& motion, const ModeStudy& study, std::uint32_t frames);

}  // namespace graze::tools
