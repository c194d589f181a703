#pragma once

#include <graze/mesh.hpp>
#include <memory>
#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::tests {

inline std::shared_ptr<const Mesh> mesh_of(const oracle::Shape& shape) {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> counts;
  for (const auto& face : shape.faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    counts.push_back(static_cast<std::uint32_t>(face.size()));
  }
  return std::make_shared<const Mesh>(Mesh::from_polygons(shape.positions, corners, counts));
}

}  // namespace graze::tests
