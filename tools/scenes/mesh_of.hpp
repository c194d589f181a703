#pragma once

#include <graze/mesh.hpp>
#include <memory>
#include <span>

#include "models/models.hpp"

namespace graze::scenes {

/// A model as a mesh of the library.
inline std::shared_ptr<const Mesh> mesh_of(const models::MeshData& data) {
  return std::make_shared<const Mesh>(
      Mesh::from_polygons(data.positions, data.corners, std::span<const std::uint32_t>(data.corner_counts)));
}

}  // namespace graze::scenes
