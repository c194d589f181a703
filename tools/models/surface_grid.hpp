#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "models/models.hpp"

namespace graze::models {

/// One quad, or two triangles split from its first corner.
void add_cell(MeshData& mesh, const std::array<std::uint32_t, 4>& cell, Faces faces);

/// Point `index` of `count` around the unit circle.
Eigen::Vector2d on_circle(std::uint32_t index, std::uint32_t count);

/// One ring of a surface of revolution around the z axis.
struct ProfilePoint {
  double radius, z;
};

/// A closed surface of revolution: a pole at z = `bottom`, a ring for each point of `profile` on the way up,
/// a pole at z = `top`. Of 2 + profile × segments vertices.
MeshData revolved(const std::vector<ProfilePoint>& profile, double bottom, double top, std::uint32_t segments,
                  Faces faces);

}  // namespace graze::models
