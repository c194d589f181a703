#pragma once

#include <filesystem>

#include "mesh/raw_object.hpp"

namespace graze::io {

/// Reads a text or binary STL file. Each solid of a text is an object, its equal vertices welded. Throws
/// InputError for a file that is cut off or announces no faces.
RawFile read_stl(const std::filesystem::path& path);

}  // namespace graze::io
