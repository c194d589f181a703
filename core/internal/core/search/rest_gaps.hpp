#pragma once

#include <cstdint>
#include <graze/export.hpp>
#include <memory>

#include "core/mesh/indexed_mesh.hpp"
#include "core/pair/self_exclusion.hpp"

namespace graze {

/// Makes the exclusion of a surface that is tested against itself, with the gaps between its features at
/// rest. To find them takes some microseconds for each vertex.
GRAZE_API std::shared_ptr<const SelfExclusion> make_self_exclusion(std::shared_ptr<const IndexedMesh> mesh,
                                                                   std::uint32_t rings);

}  // namespace graze
