#include "experiment/regions/partitions/region_hierarchy.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <utility>

namespace graze::tools {
namespace {

/// Eq. 1, in double: ties go to the lowest number where rounding leaves them ties.
std::uint32_t middle_of(std::span<const Eigen::Vector3d> rest, std::span<const std::uint32_t> vertices) {
  const Eigen::Vector3d& origin = rest[vertices.front()];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t vertex : vertices) sum += rest[vertex] - origin;
  const Eigen::Vector3d average = sum / static_cast<double>(vertices.size());
  const auto squared = [&](std::uint32_t vertex) { return (rest[vertex] - origin - average).squaredNorm(); };
  return *std::min_element(vertices.begin(), vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(squared(a), a) < std::pair(squared(b), b);
  });
}

}  // namespace

RegionHierarchy::RegionHierarchy(const Mesh& mesh, const ClusterTree& tree)
    : leaf_of_vertex_(mesh.vertex_count(), 0) {
  std::vector<std::uint32_t> cluster_of_node;
  number(tree, cluster_of_node);
  place(tree, cluster_of_node, 0);
  for (RegionNode& node : nodes_) node.middle = middle_of(mesh.rest(), part(vertices(), node));
}

void RegionHierarchy::number(const ClusterTree& tree, std::vector<std::uint32_t>& cluster_of_node) {
  nodes_.emplace_back();
  cluster_of_node.push_back(0);
  for (std::uint32_t index = 0; index < nodes_.size(); ++index) {
    const std::vector<std::uint32_t>& children = tree.clusters[cluster_of_node[index]].children;
    nodes_[index].first_child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[index].child_count = static_cast<std::uint32_t>(children.size());
    for (const std::uint32_t child : children) {
      nodes_.push_back({.level = nodes_[index].level + 1});
      cluster_of_node.push_back(child);
    }
  }
}

/// Depth first, so that what is of one region is one range.
void RegionHierarchy::place(const ClusterTree& tree, std::span<const std::uint32_t> cluster_of_node,
                            std::uint32_t index) {
  RegionNode& node = nodes_[index];
  node.first_vertex = static_cast<std::uint32_t>(vertices_.size());
  if (node.is_leaf()) {
    const std::vector<std::uint32_t>& members = tree.clusters[cluster_of_node[index]].vertices;
    vertices_.insert(vertices_.end(), members.begin(), members.end());
    for (const std::uint32_t vertex : members) leaf_of_vertex_[vertex] = index;
  }
  for (std::uint32_t child = 0; child < node.child_count; ++child)
    place(tree, cluster_of_node, node.first_child + child);
  node.vertex_count = static_cast<std::uint32_t>(vertices_.size()) - node.first_vertex;
}

std::size_t RegionHierarchy::leaf_count() const {
  return static_cast<std::size_t>(
      std::count_if(nodes_.begin(), nodes_.end(), [](const RegionNode& node) { return node.is_leaf(); }));
}

std::size_t RegionHierarchy::byte_count() const {
  return nodes_.size() * sizeof(RegionNode) + vertices_.size() * sizeof(std::uint32_t);
}

}  // namespace graze::tools
