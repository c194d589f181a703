#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/position_view.hpp>
#include <memory>
#include <string>
#include <vector>

#include "models/models.hpp"

namespace graze::tools {

/// One object, and where its vertices are in every frame.
struct RecordedObject {
  std::string name;
  std::string kind;           ///< torus, pawn, human, ...: the same for objects of one mesh
  std::uint32_t kind_id = 0;  ///< ObjectSettings::kind
  std::uint64_t group = 0;    ///< ObjectSettings::group
  models::MeshData rest;
  std::shared_ptr<const Mesh> mesh;
  std::vector<std::vector<float>> frames;  ///< x, y, z of each vertex

  [[nodiscard]] PositionView positions(std::size_t frame) const {
    return {frames[frame].data(), frames[frame].size() / 3};
  }
};

/// A motion that was made once and is played to every setting alike.
struct RecordedMotion {
  std::string name;
  double mean_edge_length = 0;  ///< at rest, of all objects
  std::vector<RecordedObject> objects;

  /// Whether two objects are parts of one body, which are not looked at against each other.
  [[nodiscard]] bool in_one_group(std::size_t a, std::size_t b) const {
    return objects[a].group != 0 && objects[a].group == objects[b].group;
  }
  [[nodiscard]] std::size_t frame_count() const { return objects.empty() ? 0 : objects[0].frames.size(); }
};

}  // namespace graze::tools
