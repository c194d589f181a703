#pragma once

#include <filesystem>
#include <graze/export.hpp>
#include <graze/io/scene_snapshot.hpp>

namespace graze::io {

/// @addtogroup io_exports
/// @{

/// Writes a frame as glTF 2: a node and a mesh of triangles for each object, and a node of points for the
/// contacts. A path that ends in `.glb` becomes a binary file, any other one a text with its data inside.
///
/// A quad becomes two triangles, split from its first corner. Positions are rounded to float, and axes stay
/// as they are. A node whose points are more than 16 times as far from 0 as they are large has a translation,
/// and its positions are relative to that. Throws InputError if the file cannot be written, if the frame has
/// no object, or if it is too large for the format.
GRAZE_API void write_gltf(const std::filesystem::path& path, const SceneSnapshot& snapshot);

/// @}

}  // namespace graze::io
