#pragma once

#include <graze/mesh.hpp>
#include <memory>

namespace graze::fuzz {

/// Meshes by their counts alone, so that a report says enough to write it again: face i is the triangle of
/// the vertices i, i + 1 and i + 2, round and round. Vertex i lies at (i, i², i³) / 8.
inline bool has_report_mesh(std::uint32_t vertices, std::uint32_t faces) {
  return vertices >= 1 && vertices <= 64 && faces >= 1 && faces <= 64;
}

inline std::shared_ptr<const Mesh> report_mesh(std::uint32_t vertices, std::uint32_t faces) {
  std::vector<Eigen::Vector3d> rest;
  for (std::uint32_t i = 0; i < vertices; ++i) rest.emplace_back(Eigen::Vector3d(i, i * i, i * i * i) / 8);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < faces; ++i)
    triangles.push_back({i % vertices, (i + 1) % vertices, (i + 2) % vertices});
  return std::make_shared<const Mesh>(Mesh::from_triangles(rest, triangles));
}

}  // namespace graze::fuzz
