#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <graze/mesh.hpp>
#include <span>
#include <vector>

namespace graze::tools {

struct NearVertexPair {
  std::uint32_t a, b;
};

/// Whether two vertices are nearer than `distance`: the same rounding everywhere.
inline bool is_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double distance) {
  return (b - a).squaredNorm() < distance * distance;
}

/// The used vertices of one mesh where it is now.
struct PlacedMesh {
  const Mesh& mesh;
  std::span<const Eigen::Vector3d> positions;
};

/// All pairs of vertices of two meshes that `is_near`, found by sorting one mesh's vertices into the cells of
/// a grid: without any hierarchy. Ordered by b, then a.
std::vector<NearVertexPair> near_vertices(const PlacedMesh& a, const PlacedMesh& b, double distance);

}  // namespace graze::tools
