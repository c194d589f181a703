#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "experiment/regions/partitions/region_hierarchy.hpp"

namespace graze::tools {

/// A binary tree over vertices. Each node's two halves have lower numbers than itself. The root is the last.
class BinaryTree {
 public:
  /// Returns the new node's number.
  std::uint32_t add_leaf(std::vector<std::uint32_t> vertices);
  std::uint32_t join(std::uint32_t left, std::uint32_t right);

  /// With up to eight children a cluster, and leaves of at most `capacity` vertices: subtrees below that are
  /// one leaf. A leaf of the binary tree with more stays as it is.
  [[nodiscard]] ClusterTree flattened(std::uint32_t capacity) const;

 private:
  struct Node {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t left = none, right = none;
    std::uint32_t vertex_count = 0;
    std::vector<std::uint32_t> vertices;  ///< of a leaf
  };
  static bool is_leaf(const Node& node, std::uint32_t capacity) {
    return node.left == Node::none || node.vertex_count <= capacity;
  }
  void collect_vertices(std::uint32_t node, std::vector<std::uint32_t>& vertices) const;
  [[nodiscard]] std::vector<std::uint32_t> children_of(std::uint32_t node, std::uint32_t capacity) const;

  std::vector<Node> nodes_;
};

}  // namespace graze::tools
