#pragma once

#include <assimp/scene.h>

#include <graze/io/mesh_file.hpp>
#include <string>
#include <string_view>

namespace graze::io {

/// Undoes what assimp (5.2) does to a COLLADA file: it puts the file's unit, and a turn that lets y point up,
/// into the root node. Returns what the file says.
FileFrame undo_collada_frame(aiScene& scene);

/// Reads axes and unit from an FBX file's global settings, which assimp does not apply.
FileFrame read_fbx_frame(const aiScene& scene);

/// Undoes the turn that assimp (5.2) puts into the root node of formats in which z points up, so that y does.
/// `extension` is in lower case.
void undo_turn_to_y_up(aiScene& scene, std::string_view extension);

}  // namespace graze::io
