#pragma once

#include "mesh/rigged_file.hpp"

namespace graze::fuzz {

/// Ends the process unless the file's indices are in range, its keys in order, and each of its objects
/// becomes a mesh and poses, or is refused for a position.
void check_rigged_file(const io::RiggedFile& file);

}  // namespace graze::fuzz
