#pragma once

#include <graze/mesh.hpp>
#include <memory>
#include <span>

namespace graze::tools {

/// Returns the mean length of all edges of some meshes at rest. An edge counts once for each mesh that has
/// it.
double mean_edge_length(std::span<const std::shared_ptr<const Mesh>> meshes);

}  // namespace graze::tools
