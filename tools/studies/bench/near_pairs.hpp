#pragma once

#include <cstddef>
#include <graze/mesh.hpp>
#include <span>

#include "bench/contender.hpp"

namespace graze::bench {

/// A mesh of triangles at the positions it has now, x, y, z of each vertex.
struct PlacedMesh {
  const Mesh& mesh;
  const float* positions;
};

/// How many pairs of a vertex of one and a face of the other, and of two edges, are nearer than a distance,
/// by double arithmetic: what task B's work is counted by. `near` has at least all pairs of triangles that
/// are as near, each once.
std::size_t count_near_pairs(const PlacedMesh& a, const PlacedMesh& b, std::span<const TrianglePair> near,
                             double distance);

}  // namespace graze::bench
