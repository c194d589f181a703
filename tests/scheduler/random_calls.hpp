#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <graze/graze.hpp>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "scheduler/scene_support.hpp"

namespace graze::tests {

/// Makes random calls on a scene, many of them wrong, and writes bound memory.
class RandomCalls {
 public:
  explicit RandomCalls(unsigned seed) : random_(seed) {}

  void make(Scene& scene) {
    if (objects_.size() < 3 || chance(8)) add(scene);
    for (int call = below(6); call > 0; --call) make_one(scene);
  }

 private:
  struct Body {
    ObjectId id;
    std::shared_ptr<const Mesh> mesh;
    Motion motion;
    bool is_solid = false;
    std::unique_ptr<Positions> memory = std::make_unique<Positions>();
    std::unique_ptr<std::vector<Eigen::Vector3f>> floats = std::make_unique<std::vector<Eigen::Vector3f>>();
  };
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }
  bool chance(int of) { return below(of) == 0; }
  double number() { return below(64) / 32.0 - 1; }
  Eigen::Vector3d offset() { return {number(), number(), number()}; }

  void add(Scene& scene) {
    Body body;
    const std::array meshes{plate_mesh(), needle_mesh(), split_plate_mesh(), box_mesh()};
    body.mesh = meshes[static_cast<std::size_t>(below(static_cast<int>(meshes.size())))];
    ObjectSettings settings;
    settings.solid = body.is_solid = body.mesh == meshes.back() && chance(2);
    settings.motion = body.motion = static_cast<Motion>(below(3));
    settings.name = chance(2) ? "named " + std::to_string(objects_.size()) : "";
    settings.kind = static_cast<std::uint32_t>(below(3));
    settings.margin = below(4) / 16.0;
    if (chance(2)) settings.face_groups = groups_of(*body.mesh);
    settings.queries = objects_.size() % 3 == 0;
    if (objects_.size() % 5 == 1) settings.patch_radius = 0.5;
    if (chance(4)) settings.hidden_groups = {group(), 7};
    body.id = scene.add(body.mesh, settings);
    objects_.push_back(std::move(body));
  }
  /// The plate as two triangles.
  static std::shared_ptr<const Mesh> split_plate_mesh() {
    constexpr std::array<std::array<std::uint32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
    return std::make_shared<const Mesh>(Mesh::from_triangles(plate_mesh()->rest(), triangles));
  }
  /// A closed surface, of one of two sizes.
  std::shared_ptr<const Mesh> box_mesh() { return mesh_of(models::box({1, 0.5, chance(2) ? 0.25 : 0.75})); }
  std::vector<std::uint8_t> groups_of(const Mesh& mesh) {
    std::vector<std::uint8_t> groups;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) groups.push_back(group());
    return groups;
  }
  std::uint8_t group() { return static_cast<std::uint8_t>(below(2)); }
  Positions placed(const Body& body) {
    Positions positions = moved(body.mesh->rest(), offset());
    if (chance(12)) positions[0].x() = std::numeric_limits<double>::quiet_NaN();
    return positions;
  }
  void make_one(Scene& scene) {
    Body& body = objects_[static_cast<std::size_t>(below(static_cast<int>(objects_.size())))];
    const double promise = chance(3) ? 8 : Scene::any_displacement;
    switch (below(16)) {
      case 0:
        return scene.set_positions(body.id, placed(body), promise);
      case 1:
      case 2:
        return write_memory(scene, body, promise);
      case 3:
        return bind(scene, body);
      case 4:
        return scene.unbind_positions(body.id);
      case 5:
        return set_pose(scene, body);
      case 6:
        return set_pose(scene, body);
      case 7:
        return scene.ignore(body.id, objects_[0].id);
      case 8:
        return scene.watch(body.id, objects_[0].id);
      case 9:
        return scene.set_rule(static_cast<std::uint32_t>(below(3)),
                              static_cast<std::uint32_t>(below(4) == 0 ? 999 : 1), {below(4) / 8.0, 1});
      case 10:
        return chance(3) ? scene.remove(body.id) : scene.positions_changed(body.id, promise);
      case 11:
      case 12:
        return ignore_or_watch_groups(scene, body.id, chance(6) ? body.id : objects_[0].id);
      case 13:
        return replace(scene, body);
      default:
        return bind(scene, body);
    }
  }
  void ignore_or_watch_groups(Scene& scene, ObjectId a, ObjectId b) {
    const std::uint8_t group_a = group();
    const std::uint8_t group_b = group();
    chance(2) ? scene.ignore(a, group_a, b, group_b) : scene.watch(a, group_a, b, group_b);
  }
  void replace(Scene& scene, Body& body) {
    auto mesh = body.is_solid ? box_mesh() : chance(2) ? plate_mesh() : needle_mesh();
    std::vector<std::uint32_t> new_of_old;
    for (std::uint32_t vertex = 0; vertex < body.mesh->vertex_count(); ++vertex)
      new_of_old.push_back(vertex < mesh->vertex_count() ? vertex : Mesh::no_vertex);
    scene.replace_mesh(body.id, mesh, new_of_old, chance(2) ? groups_of(*mesh) : std::vector<std::uint8_t>());
    body.mesh = std::move(mesh);
    body.memory->clear();
    body.floats->clear();
  }
  void bind(Scene& scene, Body& body) {
    *body.memory = placed(body);
    const BindPolicy policy = chance(2) ? BindPolicy::when_told : BindPolicy::every_step;
    if (chance(2)) return scene.bind_positions(body.id, *body.memory, policy);
    body.floats->clear();
    for (const Eigen::Vector3d& point : *body.memory) body.floats->push_back(point.cast<float>());
    scene.bind_positions(body.id, *body.floats, policy);
  }
  /// Memory of the other precision may be bound, so both say the same.
  void write_memory(Scene& scene, Body& body, double promise) {
    const Positions positions = placed(body);
    std::copy_n(positions.begin(), std::min(positions.size(), body.memory->size()), body.memory->begin());
    for (std::size_t i = 0; i < body.floats->size(); ++i) (*body.floats)[i] = positions[i].cast<float>();
    scene.positions_changed(body.id, promise);
  }
  void set_pose(Scene& scene, Body& body) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = offset();
    if (chance(8)) pose.linear() *= 2;
    scene.set_pose(body.id, pose);
  }

  std::mt19937 random_;
  std::vector<Body> objects_;
};

}  // namespace graze::tests
