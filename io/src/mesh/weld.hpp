#pragma once

#include <cstdint>
#include <vector>

#include "mesh/rig.hpp"

namespace graze::io {

/// Merges a body's vertices that are equal in position, influences and morph offsets, in order of first
/// appearance. Returns each old vertex's new number.
std::vector<std::uint32_t> weld(Body& body);

}  // namespace graze::io
