#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gltf/gltf_document.hpp"
#include "mesh/raw_object.hpp"
#include "mesh/rig.hpp"

namespace graze::io {

/// A mesh of a glTF file as one object, its vertices welded. `faces` has no positions. Its corners count the
/// body's vertices.
struct GltfMesh {
  Body body;
  RawSurface faces;
  std::size_t small_faces = 0;  ///< points, lines and corners left over
  std::vector<std::string> warnings;
};

/// Reads the joints of `skins[number]`, whose nodes are numbers of the file. `user` is the JSON path of what
/// names the skin. Throws InputError.
std::vector<Bone> read_gltf_skin(GltfDocument& document, const nlohmann::json& number,
                                 const std::string& user);

/// Joins the primitives of `meshes[number]`. The joints that it uses are the body's bones. Without a skin
/// `joints` is null. Throws InputError.
GltfMesh read_gltf_mesh(GltfDocument& document, const nlohmann::json& number,
                        const std::vector<Bone>* joints);

}  // namespace graze::io
