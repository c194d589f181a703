#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gltf/gltf_document.hpp"
#include "mesh/rig.hpp"

namespace graze::io {

/// The nodes of a glTF file, parents before children, those of the default scene first.
struct GltfNodes {
  std::vector<RigNode> nodes;
  std::vector<std::uint64_t> sources;    ///< the number in the file of each
  std::vector<std::uint32_t> number_of;  ///< where each node of the file is in `nodes`
  std::size_t scene_count = 0;           ///< so many of the first nodes are in the default scene
  std::vector<std::string> warnings;
};

/// Throws InputError for nodes that hang below themselves or below two others, and for numbers that name
/// nothing.
GltfNodes read_gltf_nodes(const GltfDocument& document);

/// The transform of a node from its parts.
RigNode make_gltf_node(std::uint32_t parent, const Eigen::Vector3d& translation,
                       const Eigen::Quaterniond& rotation, const Eigen::Vector3d& scale);

}  // namespace graze::io
