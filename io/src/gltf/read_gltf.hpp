#pragma once

#include <filesystem>

#include "mesh/rigged_file.hpp"

namespace graze::io {

/// Reads a .gltf or .glb file of version 2: the default scene, one object for each node with faces and for
/// each of its instances. A file of version 1 is left to assimp. Throws InputError.
RiggedFile read_gltf(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace graze::io
