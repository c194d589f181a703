#pragma once

#include <vector>

#include "assimp/assimp_nodes.hpp"
#include "mesh/rig.hpp"

namespace graze::io {

/// The animations of a scene.
std::vector<Clip> read_clips(const aiScene& scene, const NodeTable& nodes);

}  // namespace graze::io
