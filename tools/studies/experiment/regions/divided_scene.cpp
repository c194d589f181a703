#include "experiment/regions/divided_scene.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <tuple>

namespace graze::tools {

DividedScene::DividedScene(const PlacedFrames& scene, Partition partition, std::uint32_t capacity)
    : scene_(scene) {
  std::map<const Mesh*, std::shared_ptr<const RegionHierarchy>> made;
  for (const auto& mesh : scene.meshes) {
    auto& hierarchy = made[mesh.get()];
    if (hierarchy == nullptr) {
      const auto start = std::chrono::steady_clock::now();
      hierarchy = std::make_shared<const RegionHierarchy>(*mesh, divide(*mesh, partition, capacity));
      build_ms_ +=
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    hierarchies_.push_back(hierarchy);
  }
}

std::uint64_t DividedScene::region_count() const {
  std::uint64_t count = 0;
  for (const auto& hierarchy : hierarchies_) count += hierarchy->nodes().size();
  return count;
}

std::uint64_t DividedScene::leaf_count() const {
  std::uint64_t count = 0;
  for (const auto& hierarchy : hierarchies_) count += hierarchy->leaf_count();
  return count;
}

std::uint32_t DividedScene::level_count() const {
  std::uint32_t count = 0;
  for (const auto& hierarchy : hierarchies_) count = std::max(count, hierarchy->level_count());
  return count;
}

std::size_t DividedScene::byte_count() const {
  std::set<const RegionHierarchy*> counted;
  std::size_t count = 0;
  for (const auto& hierarchy : hierarchies_)
    if (counted.insert(hierarchy.get()).second) count += hierarchy->byte_count();
  return count;
}

std::uint64_t DividedScene::near_leaf_pairs() const {
  std::uint64_t count = 0;
  for (const PlacedFrames::Frame& frame : scene_.frames) {
    std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>> leaves;
    for (const PlacedFrames::NearPair& pair : frame.near_pairs)
      leaves.emplace(pair.object_a, pair.object_b, hierarchy(pair.object_a).leaf_of_vertex()[pair.vertices.a],
                     hierarchy(pair.object_b).leaf_of_vertex()[pair.vertices.b]);
    count += leaves.size();
  }
  return count;
}

void DividedScene::lay_out(std::size_t object, std::size_t frame,
                           std::vector<Eigen::Vector3d>& points) const {
  const auto vertices = hierarchies_[object]->vertices();
  points.resize(vertices.size());
  const std::vector<Eigen::Vector3d>& positions = scene_.frames[frame].positions[object];
  for (std::size_t i = 0; i < vertices.size(); ++i) points[i] = positions[vertices[i]];
}

}  // namespace graze::tools
