#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gltf/gltf_document.hpp"
#include "mesh/raw_object.hpp"
#include "mesh/rig.hpp"

namespace graze::io {

/// A mesh of a glTF file as one object, its vertices welded. `faces` has no positions; its corners count the
/// body's vertices.
struct GltfMesh {
  Body body;
  RawSurface faces;
  std::size_t small_faces = 0;  ///< points, lines and corners left over
  std::vector<std::string> warnings;
};

/// Joins the primitives of `meshes[number]`. With a skin its joints are the body's bones, whose nodes are
/// still numbers of the file. Throws InputError.
GltfMesh read_gltf_mesh(GltfDocument& document, const nlohmann::json& number, const nlohmann::json& skin);

}  // namespace graze::io
