#pragma once

#include <graze/scene_query.hpp>

#include "core/mesh/face_groups.hpp"
#include "core/search/pair_detector.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// The surface of a probe, with what it takes to compare it with others.
struct MeshProbe::State {
  State(std::shared_ptr<const Mesh> mesh, bool is_solid);

  /// Whether the probe would be in contact with a surface.
  [[nodiscard]] bool is_blocked_by(const Surface& other, bool other_is_solid, const FaceGroups* groups,
                                   double clearance);

  Surface surface;
  const bool solid;
  PairDetector detector;
  PairAnswer answer;
  PairCounters counters;
};

}  // namespace graze
