#pragma once

#include <vector>

#include "gltf/gltf_document.hpp"
#include "gltf/gltf_nodes.hpp"
#include "mesh/rig.hpp"

namespace graze::io {

/// The animations of a glTF file. Throws InputError for accessors that do not fit their use.
std::vector<Clip> read_gltf_clips(GltfDocument& document, const GltfNodes& nodes);

}  // namespace graze::io
