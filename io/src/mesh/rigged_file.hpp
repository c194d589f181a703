#pragma once

#include <graze/io/mesh_file.hpp>

#include "mesh/raw_object.hpp"
#include "mesh/rig.hpp"

namespace graze::io {

/// A file with nodes, as its reader gives it. Object i of `file` is body i of `rig`, posed as it stands while
/// nothing plays.
struct RiggedFile {
  RawFile file;
  Rig rig;
  FileFrame frame;
};

}  // namespace graze::io
