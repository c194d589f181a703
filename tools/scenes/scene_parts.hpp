#pragma once

#include <graze/graze.hpp>
#include <memory>

#include "models/models.hpp"
#include "scenes/grid.hpp"
#include "scenes/mesh_of.hpp"

namespace graze::scenes {

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
