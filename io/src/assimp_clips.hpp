#pragma once

#include <vector>

#include "assimp_nodes.hpp"
#include "gltf_source.hpp"
#include "rig.hpp"

namespace graze::io {

/// The animations of a scene. `steps` names the tracks that jump from key to key.
std::vector<Clip> read_clips(const aiScene& scene, const NodeTable& nodes, const SteppedTracks& steps);

}  // namespace graze::io
