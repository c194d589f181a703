#include "experiment/regions/partitions/binary_tree.hpp"

#include <algorithm>

namespace graze::tools {

std::uint32_t BinaryTree::add_leaf(std::vector<std::uint32_t> vertices) {
  Node node;
  node.vertex_count = static_cast<std::uint32_t>(vertices.size());
  node.vertices = std::move(vertices);
  nodes_.push_back(std::move(node));
  return static_cast<std::uint32_t>(nodes_.size()) - 1;
}

std::uint32_t BinaryTree::join(std::uint32_t left, std::uint32_t right) {
  Node node;
  node.left = left;
  node.right = right;
  node.vertex_count = nodes_[left].vertex_count + nodes_[right].vertex_count;
  nodes_.push_back(std::move(node));
  return static_cast<std::uint32_t>(nodes_.size()) - 1;
}

ClusterTree BinaryTree::flattened(std::uint32_t capacity) const {
  ClusterTree tree;
  std::vector<std::uint32_t> node_of_cluster{static_cast<std::uint32_t>(nodes_.size()) - 1};
  tree.clusters.emplace_back();
  for (std::size_t index = 0; index < tree.clusters.size(); ++index) {
    const std::uint32_t node = node_of_cluster[index];
    if (is_leaf(nodes_[node], capacity)) {
      collect_vertices(node, tree.clusters[index].vertices);
      continue;
    }
    for (const std::uint32_t child : children_of(node, capacity)) {
      tree.clusters[index].children.push_back(static_cast<std::uint32_t>(tree.clusters.size()));
      tree.clusters.emplace_back();
      node_of_cluster.push_back(child);
    }
  }
  return tree;
}

void BinaryTree::collect_vertices(std::uint32_t node, std::vector<std::uint32_t>& vertices) const {
  std::vector<std::uint32_t> open{node};
  while (!open.empty()) {
    const Node& next = nodes_[open.back()];
    open.pop_back();
    if (next.left == Node::none) {
      vertices.insert(vertices.end(), next.vertices.begin(), next.vertices.end());
    } else {
      open.push_back(next.right);
      open.push_back(next.left);
    }
  }
}

std::vector<std::uint32_t> BinaryTree::children_of(std::uint32_t node, std::uint32_t capacity) const {
  std::vector<std::uint32_t> children{node};
  while (children.size() < 8) {
    const auto size_to_split = [&](std::uint32_t child) {
      return is_leaf(nodes_[child], capacity) ? 0 : nodes_[child].vertex_count;
    };
    const auto largest = std::max_element(
        children.begin(), children.end(),
        [&](std::uint32_t a, std::uint32_t b) { return size_to_split(a) < size_to_split(b); });
    if (size_to_split(*largest) == 0) break;
    const Node& split = nodes_[*largest];
    *largest = split.left;
    children.insert(largest + 1, split.right);
  }
  return children;
}

}  // namespace graze::tools
