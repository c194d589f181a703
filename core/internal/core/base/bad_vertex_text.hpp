#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "core/base/number_text.hpp"

namespace graze {

/// Says where a vertex is that no object takes.
inline std::string bad_vertex_text(std::uint32_t vertex, const Eigen::Vector3d& position) {
  return "vertex " + std::to_string(vertex) + " is at " + number_text(position.x()) + ", " +
         number_text(position.y()) + ", " + number_text(position.z()) +
         (position.allFinite() ? ", beyond 2^120" : "");
}

}  // namespace graze
