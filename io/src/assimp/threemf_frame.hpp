#pragma once

#include <filesystem>
#include <graze/io/mesh_file.hpp>

namespace graze::io {

/// Reads the unit of a 3MF file, which assimp (5.2) does not. By the standard it is a millimetre where the
/// file names none, and z points up. Says nothing of a file whose model is not found.
FileFrame read_threemf_frame(const std::filesystem::path& path);

}  // namespace graze::io
