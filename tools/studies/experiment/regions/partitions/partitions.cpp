#include "experiment/regions/partitions/partitions.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "core/base/box.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/mesh/region_tree.hpp"
#include "experiment/regions/partitions/binary_tree.hpp"
#include "experiment/regions/partitions/edge_collapse.hpp"
#include "experiment/regions/partitions/surface_halves.hpp"

namespace graze::tools {
namespace {

ClusterTree octree_of(const Mesh& mesh) {
  const RegionTree regions(indexed(mesh));  // made anew, so that a build takes as long as it does
  ClusterTree tree;
  for (const Region& region : regions.regions()) {
    ClusterTree::Cluster& cluster = tree.clusters.emplace_back();
    const auto vertices = regions.vertices(region);
    if (region.is_leaf()) cluster.vertices.assign(vertices.begin(), vertices.end());
    for (std::uint32_t child = 0; child < region.child_count; ++child)
      cluster.children.push_back(region.first_child + child);
  }
  return tree;
}

/// Sorts a region's vertices so that its first half is across the longest side of its box from the second.
void sort_halves_by_place(const Mesh& mesh, std::span<std::uint32_t> vertices) {
  Box box;
  for (const std::uint32_t vertex : vertices) box.add(mesh.rest()[vertex]);
  Eigen::Index axis = 0;
  (box.max - box.min).maxCoeff(&axis);
  std::sort(vertices.begin(), vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(mesh.rest()[a][axis], a) < std::pair(mesh.rest()[b][axis], b);
  });
}

/// Halves a region's vertices as `sort_halves` leaves them until leaves are small enough.
template <typename SortHalves>
std::uint32_t halve(std::span<std::uint32_t> vertices, std::uint32_t capacity, const SortHalves& sort_halves,
                    BinaryTree& tree) {
  if (vertices.size() <= capacity) return tree.add_leaf({vertices.begin(), vertices.end()});
  const std::size_t half = sort_halves(vertices);
  const std::uint32_t left = halve(vertices.first(half), capacity, sort_halves, tree);
  const std::uint32_t right = halve(vertices.subspan(half), capacity, sort_halves, tree);
  return tree.join(left, right);
}

std::vector<std::uint32_t> used_vertices(const Mesh& mesh) {
  const auto vertices = indexed(mesh).regions().vertices();
  std::vector<std::uint32_t> used(vertices.begin(), vertices.end());
  std::sort(used.begin(), used.end());
  return used;
}

ClusterTree median_tree(const Mesh& mesh, std::uint32_t capacity) {
  std::vector<std::uint32_t> vertices = used_vertices(mesh);
  BinaryTree tree;
  halve(
      std::span(vertices), capacity,
      [&](std::span<std::uint32_t> part) {
        sort_halves_by_place(mesh, part);
        return part.size() / 2;
      },
      tree);
  return tree.flattened(capacity);
}

ClusterTree surface_tree(const Mesh& mesh, std::uint32_t capacity) {
  std::vector<std::uint32_t> vertices = used_vertices(mesh);
  BinaryTree tree;
  SurfaceHalves halves(mesh);
  halve(
      std::span(vertices), capacity, [&](std::span<std::uint32_t> part) { return halves.sort(part); }, tree);
  return tree.flattened(capacity);
}

}  // namespace

const char* name_of(Partition partition) {
  switch (partition) {
    case Partition::octree:
      return "octree";
    case Partition::median:
      return "median";
    case Partition::surface_halves:
      return "surface halves";
    case Partition::edge_collapse:
      break;
  }
  return "edge collapse";
}

ClusterTree divide(const Mesh& mesh, Partition partition, std::uint32_t capacity) {
  switch (partition) {
    case Partition::octree:
      return octree_of(mesh);
    case Partition::median:
      return median_tree(mesh, capacity);
    case Partition::surface_halves:
      return surface_tree(mesh, capacity);
    case Partition::edge_collapse:
      break;
  }
  return collapsed(mesh).flattened(capacity);
}

}  // namespace graze::tools
