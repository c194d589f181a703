#pragma once

#include <assimp/scene.h>

#include <graze/io/mesh_file.hpp>
#include <string>

namespace graze::io {

/// Undoes what assimp (5.2) does to a COLLADA file: it puts the file's unit, and a turn that lets y point up,
/// into the root node. Returns what the file says.
FileFrame undo_collada_frame(aiScene& scene);

/// What an FBX file's global settings say. assimp does not apply them.
FileFrame read_fbx_frame(const aiScene& scene);

}  // namespace graze::io
