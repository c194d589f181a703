#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace graze {

/// The vertex of a region that is closest to the average of the region's vertices (eq. 1), decided as in real
/// arithmetic. Ties go to the lowest number. `vertices` has at least one index into `positions`.
std::uint32_t middle_vertex(std::span<const Eigen::Vector3d> positions,
                            std::span<const std::uint32_t> vertices);

}  // namespace graze
