#pragma once

#include <assimp/scene.h>

#include <filesystem>

#include "read_assimp.hpp"

namespace graze::io {

/// The objects, nodes and animations of what assimp has read from `path`, whose extension says what the
/// format means by a morph target's weight. Throws InputError for numbers that name nothing.
RiggedFile convert_scene(const std::filesystem::path& path, const aiScene& scene);

}  // namespace graze::io
