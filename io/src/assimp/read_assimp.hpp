#pragma once

#include <filesystem>

#include "mesh/rigged_file.hpp"

namespace graze::io {

/// Reads a file of any format that assimp knows. Throws InputError that tells a format that is not read from
/// a damaged file.
RiggedFile read_assimp(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace graze::io
