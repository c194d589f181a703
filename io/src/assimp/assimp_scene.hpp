#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/rigged_file.hpp"

namespace graze::io {

/// The objects, nodes and animations of what assimp has read from `path`, whose extension says what the
/// format means by a morph target's weight. Throws InputError for numbers that name nothing.
RiggedFile convert_scene(const std::filesystem::path& path, const aiScene& scene);

/// The names of the nodes with faces, in the order of the objects that `convert_scene` makes.
std::vector<std::string> object_names(const aiScene& scene);

}  // namespace graze::io
