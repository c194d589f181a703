#pragma once

#include <assimp/scene.h>

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesh/rig.hpp"

namespace graze::io {

/// The nodes of a scene, parents before children, with their numbers by name.
struct NodeTable {
  explicit NodeTable(const aiScene& scene);

  /// The first node of that name.
  [[nodiscard]] std::optional<std::uint32_t> find(const std::string& name) const {
    const auto entry = by_name.find(name);
    return entry == by_name.end() ? std::nullopt : std::optional(entry->second);
  }

  std::vector<RigNode> nodes;
  std::vector<const aiNode*> sources;  ///< what each node was made of
  std::unordered_map<std::string, std::uint32_t> by_name;
};

}  // namespace graze::io
