#pragma once

#include <assimp/scene.h>

#include <filesystem>

#include "gltf_source.hpp"
#include "read_assimp.hpp"

namespace graze::io {

/// The objects, nodes and animations of what assimp has read from `path`, whose extension says what the
/// format means by a morph target's weight. `steps` names the tracks that jump from key to key. Throws
/// InputError for numbers that name nothing.
RiggedFile convert_scene(const std::filesystem::path& path, const aiScene& scene, const SteppedTracks& steps);

}  // namespace graze::io
