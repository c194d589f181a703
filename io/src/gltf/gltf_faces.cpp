#include "gltf/gltf_faces.hpp"

namespace graze::io {
namespace {

constexpr std::uint64_t points = 0;
constexpr std::uint64_t lines = 1;
constexpr std::uint64_t line_loop = 2;
constexpr std::uint64_t line_strip = 3;
constexpr std::uint64_t triangles = 4;
constexpr std::uint64_t triangle_strip = 5;

std::size_t points_or_lines(std::uint64_t mode, std::size_t corners) {
  if (mode == points || mode == line_loop) return corners;
  if (mode == lines) return corners / 2;
  return corners > 1 ? corners - 1 : 0;
}

}  // namespace

GltfFaces make_gltf_faces(std::uint64_t mode, const std::vector<std::uint64_t>& corners) {
  GltfFaces faces;
  if (mode <= line_strip) {
    faces.small_faces = points_or_lines(mode, corners.size());
    return faces;
  }
  if (mode == triangles) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      faces.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    faces.small_faces = corners.size() % 3 == 0 ? 0 : 1;
    return faces;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    if (mode != triangle_strip) {
      faces.triangles.push_back({corners[0], corners[i - 1], corners[i]});
      continue;
    }
    const std::uint64_t a = corners[i % 2 == 0 ? i - 2 : i - 1];
    const std::uint64_t b = corners[i % 2 == 0 ? i - 1 : i - 2];
    if (a != b && b != corners[i] && corners[i] != a) faces.triangles.push_back({a, b, corners[i]});
  }
  return faces;
}

}  // namespace graze::io
