#pragma once

#include <string>
#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// Triangle meshes in two of the plainest forms of their formats, read without graze::io. Both throw
/// std::runtime_error for anything else.

/// A binary little-endian PLY of double positions and faces as lists of uint8 counts and int32 corners.
oracle::Shape read_ply(const std::string& path);

/// The objects ("o") of an OBJ file of "v" and "f" lines, each with its own vertices.
std::vector<oracle::Shape> read_obj_objects(const std::string& path);

/// The connected pieces of a shape, in the order of their first faces, each with its own vertices.
std::vector<oracle::Shape> pieces_of(const oracle::Shape& shape);

}  // namespace graze::tests
