#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

#include "assimp/assimp_nodes.hpp"
#include "mesh/raw_object.hpp"
#include "mesh/rig.hpp"

namespace graze::io {

/// One node's meshes as one object. `faces` has no positions. Its corners count the body's vertices.
struct NodeObject {
  Body body;
  RawSurface faces;
  std::size_t small_faces = 0;          ///< points and lines left out
  std::set<std::string> missing_bones;  ///< without a node. Their weights are left out
};

/// Joins the meshes of a node and welds their vertices. `use_rest_weights`: whether the file's format gives
/// morph targets a weight while nothing plays. Throws InputError for a number that names no
/// mesh or vertex.
NodeObject read_node_object(const std::filesystem::path& path, const aiScene& scene, const NodeTable& nodes,
                            std::uint32_t node, bool use_rest_weights);

}  // namespace graze::io
