#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace graze::io {

/// The triangles of a primitive, and how many points, lines and corners left over it has besides.
struct GltfFaces {
  std::vector<std::array<std::uint64_t, 3>> triangles;
  std::size_t small_faces = 0;
};

/// Makes triangles of a primitive's corners. `mode` is 4 for triangles, 5 for a strip and 6 for a fan. 0 to 3
/// are points and lines. A triangle of a strip that names one vertex twice joins two parts of it and is no
/// face.
GltfFaces make_gltf_faces(std::uint64_t mode, const std::vector<std::uint64_t>& corners);

}  // namespace graze::io
