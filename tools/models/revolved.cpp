#include "models/models.hpp"
#include "models/surface_grid.hpp"

namespace graze::models {

MeshData revolved(const std::vector<ProfilePoint>& profile, double bottom, double top, std::uint32_t segments,
                  Faces faces) {
  MeshData mesh;
  mesh.positions.emplace_back(0, 0, bottom);
  for (const ProfilePoint& point : profile) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      const Eigen::Vector2d outward = on_circle(i, segments);
      mesh.positions.emplace_back(point.radius * outward.x(), point.radius * outward.y(), point.z);
    }
  }
  mesh.positions.emplace_back(0, 0, top);

  const auto ring_count = static_cast<std::uint32_t>(profile.size());
  const auto at = [&](std::uint32_t ring, std::uint32_t i) { return 1 + ring * segments + i % segments; };
  const std::uint32_t last = 1 + ring_count * segments;
  for (std::uint32_t i = 0; i < segments; ++i) mesh.add_face({0, at(0, i + 1), at(0, i)});
  for (std::uint32_t ring = 0; ring + 1 < ring_count; ++ring)
    for (std::uint32_t i = 0; i < segments; ++i)
      add_cell(mesh, {at(ring, i), at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)}, faces);
  for (std::uint32_t i = 0; i < segments; ++i)
    mesh.add_face({at(ring_count - 1, i), at(ring_count - 1, i + 1), last});
  return mesh;
}

MeshData torus(Faces faces) {
  return torus(48, 16, 0.7, 0.3, faces);
}

MeshData cylinder(Faces faces) {
  const std::vector<ProfilePoint> profile = {{0.3, -0.8}, {0.6, -0.8}, {0.6, -0.48}, {0.6, -0.16},
                                             {0.6, 0.16}, {0.6, 0.48}, {0.6, 0.8},   {0.3, 0.8}};
  return revolved(profile, -0.8, 0.8, 32, faces);
}

MeshData pawn(Faces faces) {
  const std::vector<ProfilePoint> profile = {
      {0.34, -1.0},                                                               // under the foot
      {0.58, -1.0},  {0.62, -0.93}, {0.60, -0.80}, {0.51, -0.72}, {0.46, -0.62},  // the foot
      {0.36, -0.50}, {0.26, -0.28}, {0.21, -0.04}, {0.20, 0.16},                  // the stem
      {0.36, 0.23},  {0.37, 0.29},  {0.21, 0.36},                                 // the collar
      {0.31, 0.45},  {0.365, 0.57}, {0.37, 0.67},  {0.33, 0.80},  {0.24, 0.91},  {0.12, 0.98}};  // the head
  return revolved(profile, -1.0, 1.0, 32, faces);
}

}  // namespace graze::models
