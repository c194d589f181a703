#pragma once

#include <Eigen/Core>
#include <graze/mesh.hpp>
#include <span>
#include <string>

namespace graze::tools {

/// A few lines about one mesh at rest, each after `indent`: counts, oddities, regions, epsilon of each level,
/// bytes.
std::string summarise_mesh(const Mesh& mesh, const std::string& indent);

/// "from 0 0 0 to 1 1 1": the smallest and the largest coordinates of the positions.
std::string bounds_text(std::span<const Eigen::Vector3d> positions);

}  // namespace graze::tools
