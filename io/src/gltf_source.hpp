#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace graze::io {

/// Tracks that jump from key to key: the animation's number, the node's name, and what it animates
/// (translation, rotation, scale, weights).
using SteppedTracks = std::set<std::tuple<std::size_t, std::string, std::string>>;

/// A primitive of faces.
struct GltfPrimitive {
  std::string place;  ///< in the file, for messages
  std::uint64_t face_count = 0;
};

/// A glTF 2 file prepared for assimp (5.2), which finds joints and animated nodes by name and so mixes up
/// nodes without a name or with the same, forgets steps, and drops faces that name no vertex without a word.
struct GltfSource {
  std::string bytes;  ///< the file with a unique name for each node and mesh
  SteppedTracks steps;
  /// Primitives of faces by the name that assimp gives their meshes.
  std::map<std::string, GltfPrimitive> primitives;
  std::vector<std::string> warnings;
};

/// Nothing for glTF 1, which assimp reads as it is. Throws InputError.
std::optional<GltfSource> prepare_gltf(const std::filesystem::path& path);

}  // namespace graze::io
