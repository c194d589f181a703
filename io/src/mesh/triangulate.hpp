#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace graze::io {

/// Cuts a polygon of n ≥ 3 corners into n − 2 triangles with the polygon's winding, by clipping ears in the
/// plane that fits it best. A polygon that is not simple is cut all the same, somehow. Nothing where a
/// polygon of very many corners would take too long, whatever the machine.
std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate(
    std::span<const Eigen::Vector3d> positions, std::span<const std::uint32_t> polygon);

}  // namespace graze::io
