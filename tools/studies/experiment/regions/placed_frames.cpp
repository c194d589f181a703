#include "experiment/regions/placed_frames.hpp"

#include <algorithm>

namespace graze::tools {
namespace {

std::vector<Eigen::Vector3d> as_points(const std::vector<float>& coordinates) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(coordinates.size() / 3);
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
    points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  return points;
}

void add_near_pairs(const PlacedFrames& scene, PlacedFrames::Frame& frame) {
  for (std::uint32_t b = 1; b < scene.meshes.size(); ++b)
    for (std::uint32_t a = 0; a < b; ++a)
      for (const NearVertexPair& pair : near_vertices({*scene.meshes[a], frame.positions[a]},
                                                      {*scene.meshes[b], frame.positions[b]}, scene.distance))
        frame.near_pairs.push_back({a, b, pair});
}

}  // namespace

std::size_t PlacedFrames::vertex_count() const {
  std::size_t count = 0;
  for (const auto& mesh : meshes) count += mesh->vertex_count();
  return count;
}

std::uint64_t PlacedFrames::near_pair_count() const {
  std::uint64_t count = 0;
  for (const Frame& frame : frames) count += frame.near_pairs.size();
  return count;
}

PlacedFrames place_frames(const bench::BenchScene& scene, std::size_t count) {
  PlacedFrames placed{scene.name, scene.what, scene.distance, {}, {}};
  std::vector<std::vector<float>> now;
  for (const bench::Body& body : scene.bodies) {
    placed.meshes.push_back(body.mesh);
    now.emplace_back(std::size_t{3} * body.mesh->vertex_count(), 0.0F);
  }
  count = std::min(count, scene.frames);
  std::size_t taken = 0;
  for (std::size_t frame = 0; frame < scene.frames && taken < count; ++frame) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) scene.bodies[i].place(frame, now[i]);
    if (count > 1 && frame * (count - 1) < taken * (scene.frames - 1)) continue;
    ++taken;
    PlacedFrames::Frame& next = placed.frames.emplace_back();
    for (const std::vector<float>& coordinates : now) next.positions.push_back(as_points(coordinates));
    add_near_pairs(placed, next);
  }
  return placed;
}

}  // namespace graze::tools
