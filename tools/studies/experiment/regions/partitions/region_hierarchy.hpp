#pragma once

#include <cstdint>
#include <graze/mesh.hpp>
#include <span>
#include <vector>

namespace graze::tools {

/// How a mesh's used vertices are divided: a tree whose leaves together name each of them once. Cluster 0 is
/// the root.
struct ClusterTree {
  struct Cluster {
    std::vector<std::uint32_t> children;  ///< clusters, none for a leaf
    std::vector<std::uint32_t> vertices;  ///< of a leaf
  };
  std::vector<Cluster> clusters;
};

/// A region of any partition. The fields mean what they do in graze's Region.
struct RegionNode {
  std::uint32_t level = 0;
  std::uint32_t first_child = 0;
  std::uint32_t child_count = 0;
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  std::uint32_t middle = 0;

  [[nodiscard]] bool is_leaf() const { return child_count == 0; }
};

/// Regions by any partition, alike for all: numbered level by level, children of one together. A region's
/// vertices are one range.
class RegionHierarchy {
 public:
  RegionHierarchy(const Mesh& mesh, const ClusterTree& tree);

  [[nodiscard]] std::span<const RegionNode> nodes() const { return nodes_; }
  [[nodiscard]] std::uint32_t level_count() const { return nodes_.back().level + 1; }
  [[nodiscard]] std::size_t leaf_count() const;
  /// The leaf of each vertex of the mesh. Of an unused one it means nothing.
  [[nodiscard]] std::span<const std::uint32_t> leaf_of_vertex() const { return leaf_of_vertex_; }
  /// The mesh's used vertices, region after region.
  [[nodiscard]] std::span<const std::uint32_t> vertices() const { return vertices_; }
  /// The part of `of_all`, which has something for each of vertices(), that is of one region.
  template <typename Value>
  static std::span<const Value> part(std::span<const Value> of_all, const RegionNode& node) {
    return of_all.subspan(node.first_vertex, node.vertex_count);
  }
  /// The bytes of nodes and vertex numbers. Those of bounds come on top.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void number(const ClusterTree& tree, std::vector<std::uint32_t>& cluster_of_node);
  void place(const ClusterTree& tree, std::span<const std::uint32_t> cluster_of_node, std::uint32_t index);

  std::vector<RegionNode> nodes_;
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> leaf_of_vertex_;
};

}  // namespace graze::tools
