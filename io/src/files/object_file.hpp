#pragma once

#include <filesystem>
#include <graze/io/mesh_file.hpp>

#include "mesh/rigged_file.hpp"

namespace graze::io {

/// Reads a mesh file with the reader for its format, chosen by its extension. Objects may be without faces,
/// and the rig is empty where the format has none. Throws InputError.
RiggedFile read_objects(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace graze::io
