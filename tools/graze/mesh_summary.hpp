#pragma once

#include <graze/mesh.hpp>
#include <string>

namespace graze::tools {

/// A few lines about one mesh at rest, each after `indent`: counts, oddities, regions, epsilon of each level,
/// bytes.
std::string summarise_mesh(const Mesh& mesh, const std::string& indent);

}  // namespace graze::tools
