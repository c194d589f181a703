#pragma once

#include <graze/graze.hpp>
#include <memory>
#include <span>

#include "models/models.hpp"
#include "scenes/grid.hpp"

namespace graze::scenes {

inline std::shared_ptr<const Mesh> mesh_of(const models::MeshData& data) {
  return std::make_shared<const Mesh>(
      Mesh::from_polygons(data.positions, data.corners, std::span<const std::uint32_t>(data.corner_counts)));
}

/// As models make them up to the last bits of sine and cosine, which are rounded away.
inline std::shared_ptr<const Mesh> mesh_on_grid(models::MeshData data) {
  for (Eigen::Vector3d& position : data.positions) position = on_grid(position);
  return mesh_of(data);
}

inline SceneSettings settings_of(double contact_distance, double range) {
  SceneSettings settings;
  settings.contact_distance = contact_distance;
  settings.range = range;
  settings.detail = ContactDetail::features;
  return settings;
}

}  // namespace graze::scenes
