#include "experiment/regions/partitions/edge_collapse.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

namespace graze::tools {
namespace {

/// A region that edges still lead from. It is numbered as its node in the tree.
struct Cluster {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double vertex_count = 0;
  bool is_live = true;
  std::vector<std::uint32_t> neighbours;  ///< clusters, some of them merged since
};

class Collapse {
 public:
  explicit Collapse(const Mesh& mesh) {
    std::vector<std::uint32_t> cluster_of(mesh.vertex_count(), 0);
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex)
      if (mesh.is_used(vertex)) {
        cluster_of[vertex] = tree_.add_leaf({vertex});
        clusters_.push_back({mesh.rest()[vertex], 1, true, {}});
        merged_into_.push_back(cluster_of[vertex]);
      }
    for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) {
      const auto [a, b] = mesh.edge(edge);
      clusters_[cluster_of[a]].neighbours.push_back(cluster_of[b]);
      clusters_[cluster_of[b]].neighbours.push_back(cluster_of[a]);
      offer(cluster_of[a], cluster_of[b]);
    }
  }

  BinaryTree run() {
    while (!open_.empty()) {
      const auto [cost, a, b] = open_.top();
      open_.pop();
      if (clusters_[a].is_live && clusters_[b].is_live) merge(a, b);
    }
    join_components();
    return std::move(tree_);
  }

 private:
  using Edge = std::tuple<double, std::uint32_t, std::uint32_t>;

  void offer(std::uint32_t a, std::uint32_t b) {
    const Cluster& one = clusters_[a];
    const Cluster& other = clusters_[b];
    const double weight = one.vertex_count * other.vertex_count / (one.vertex_count + other.vertex_count);
    open_.emplace(weight * (one.mean - other.mean).squaredNorm(), std::min(a, b), std::max(a, b));
  }

  void merge(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t merged = tree_.join(a, b);
    Cluster cluster;
    Cluster& one = clusters_[a];
    Cluster& other = clusters_[b];
    one.is_live = other.is_live = false;
    merged_into_.push_back(merged);
    merged_into_[a] = merged_into_[b] = merged;
    cluster.vertex_count = one.vertex_count + other.vertex_count;
    cluster.mean = (one.vertex_count * one.mean + other.vertex_count * other.mean) / cluster.vertex_count;
    for (const auto* from : {&one.neighbours, &other.neighbours})
      for (const std::uint32_t neighbour : *from) cluster.neighbours.push_back(live(neighbour));
    one.neighbours = other.neighbours = {};
    std::vector<std::uint32_t>& around = cluster.neighbours;
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    around.erase(std::remove(around.begin(), around.end(), merged), around.end());
    clusters_.push_back(std::move(cluster));
    for (const std::uint32_t neighbour : clusters_[merged].neighbours) {
      clusters_[neighbour].neighbours.push_back(merged);
      offer(merged, neighbour);
    }
  }

  /// The cluster that one is part of now.
  std::uint32_t live(std::uint32_t cluster) {
    while (merged_into_[cluster] != cluster)
      cluster = merged_into_[cluster] = merged_into_[merged_into_[cluster]];
    return cluster;
  }

  void join_components() {
    std::uint32_t joined = 0;
    bool is_first = true;
    for (std::uint32_t cluster = 0; cluster < clusters_.size(); ++cluster)
      if (clusters_[cluster].is_live) {
        joined = is_first ? cluster : tree_.join(joined, cluster);
        is_first = false;
      }
  }

  BinaryTree tree_;
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> merged_into_;  ///< itself while it is live
  std::priority_queue<Edge, std::vector<Edge>, std::greater<>> open_;
};

}  // namespace

BinaryTree collapsed(const Mesh& mesh) {
  return Collapse(mesh).run();
}

}  // namespace graze::tools
