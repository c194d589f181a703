#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/scenes/scenes.hpp"

namespace graze::bench {
namespace {

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> triangles(mesh.face_count());
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i)
    for (std::size_t corner = 0; corner < 3; ++corner) triangles[i].corners[corner] = mesh.face(i)[corner];
  return triangles;
}

/// At least how far the vertex that moved furthest did.
double furthest(std::span<const float> before, std::span<const float> now) {
  double squared = 0;
  for (std::size_t i = 0; i < now.size(); i += 3) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double by = static_cast<double>(now[i + axis]) - static_cast<double>(before[i + axis]);
      sum += by * by;
    }
    squared = std::max(squared, sum);
  }
  return std::sqrt(squared) * (1 + 0x1p-50);
}

}  // namespace

MovingWorld::MovingWorld(BenchScene scene) : scene_(std::move(scene)) {
  world_.distance = scene_.distance;
  std::map<const Mesh*, std::size_t> numbers;
  for (const Body& body : scene_.bodies)
    if (numbers.emplace(body.mesh.get(), triangles_.size()).second)
      triangles_.push_back(triangles_of(*body.mesh));
  std::size_t count = 0;
  for (const Body& body : scene_.bodies) {
    world_.objects.push_back(
        {count, body.mesh->vertex_count(), triangles_[numbers.at(body.mesh.get())], body.is_fixed});
    count += body.mesh->vertex_count();
  }
  world_.positions.resize(3 * count);
  world_.displacements.resize(scene_.bodies.size());
  world_.versions.resize(scene_.bodies.size());
  place(0);
}

void MovingWorld::place(std::size_t frame) {
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    const WorldObject& object = world_.objects[i];
    const auto now =
        std::span(world_.positions).subspan(3 * object.first_vertex, std::size_t{3} * object.vertex_count);
    before_.assign(now.begin(), now.end());
    const bool changed = scene_.bodies[i].place(frame, now);
    world_.displacements[i] = changed ? furthest(before_, now) : 0;
    if (changed) ++world_.versions[i];
  }
}

}  // namespace graze::bench
