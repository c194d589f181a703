#pragma once

#include <filesystem>

#include "raw_object.hpp"
#include "rig.hpp"

namespace graze::io {

/// What assimp makes of a file. Object i of `file` is body i of `rig`, posed as it stands while nothing
/// plays.
struct RiggedFile {
  RawFile file;
  Rig rig;
};

/// Reads a file of any format that assimp knows. Throws InputError.
RiggedFile read_assimp(const std::filesystem::path& path);

}  // namespace graze::io
