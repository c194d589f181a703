#pragma once

#include <assimp/scene.h>

#include <memory>
#include <string>

#include "fuzz/byte_reader.hpp"

namespace graze::fuzz {

/// A scene as an importer of assimp may leave it: faces of any number of corners, numbers that name nothing,
/// meshes without positions, morph targets and keys that do not fit, nodes that share names, any float.
/// Arrays have the lengths that they say, and no entry of them is null.
std::unique_ptr<aiScene> build_assimp_scene(ByteReader& reader);

/// One of the few names that its nodes, bones and channels have.
std::string pick_name(ByteReader& reader);

}  // namespace graze::fuzz
