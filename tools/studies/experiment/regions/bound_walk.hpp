#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "experiment/regions/bounding_volumes.hpp"
#include "experiment/regions/partitions/region_hierarchy.hpp"

namespace graze::tools {

/// The points of a hierarchy's regions where they are now, region after region.
struct PlacedRegions {
  const RegionHierarchy& hierarchy;
  std::span<const Eigen::Vector3d> points;     ///< as RegionHierarchy::vertices() names them
  std::span<const Eigen::Vector3d> positions;  ///< of the mesh's vertices
};

/// The bounds of all regions from their points. Those of inner regions are made from their children's where
/// that is the same.
template <typename Volume>
void refit(const PlacedRegions& placed, std::vector<Volume>& volumes) {
  const auto nodes = placed.hierarchy.nodes();
  volumes.resize(nodes.size());
  for (std::size_t index = nodes.size(); index-- > 0;) {
    const RegionNode& node = nodes[index];
    if constexpr (Volume::merges)
      if (!node.is_leaf()) {
        volumes[index] = volumes[node.first_child];
        for (std::uint32_t child = 1; child < node.child_count; ++child)
          volumes[index].add(volumes[node.first_child + child]);
        continue;
      }
    volumes[index] =
        Volume::around({RegionHierarchy::part(placed.points, node), placed.positions[node.middle]});
  }
}

struct NodePair {
  std::uint32_t a = 0, b = 0;
};

/// Counts the pairs of regions in the walks of a pair of objects.
struct WalkCounts {
  std::uint64_t tested = 0;
  std::uint64_t reached = 0;            ///< pairs of leaves that may be near
  std::vector<std::uint64_t> expanded;  ///< pairs, by the deeper one's level
};

/// The regions of two objects with their bounds.
template <typename Volume>
struct BoundedPair {
  std::span<const RegionNode> nodes_a, nodes_b;
  std::span<const Volume> a, b;
};

/// DMV with bounds, breadth first from the roots. Both regions of a pair make way for their children, and a
/// leaf stays. Calls `leaves(pair)` for each pair of leaves whose bound is below `distance`.
template <typename Volume, typename Leaves>
void walk(const BoundedPair<Volume>& pair, double distance, WalkCounts& counts, const Leaves& leaves) {
  std::vector<NodePair> front{{}};
  std::vector<NodePair> next;
  while (!front.empty()) {
    next.clear();
    for (const NodePair& regions : front) {
      ++counts.tested;
      if (!(lower_distance(pair.a[regions.a], pair.b[regions.b]) < distance)) continue;
      const RegionNode& a = pair.nodes_a[regions.a];
      const RegionNode& b = pair.nodes_b[regions.b];
      if (a.is_leaf() && b.is_leaf()) {
        ++counts.reached;
        leaves(regions);
        continue;
      }
      const std::size_t level = std::max(a.level, b.level);
      if (counts.expanded.size() <= level) counts.expanded.resize(level + 1, 0);
      ++counts.expanded[level];
      const std::uint32_t first_a = a.is_leaf() ? regions.a : a.first_child;
      const std::uint32_t first_b = b.is_leaf() ? regions.b : b.first_child;
      const std::uint32_t end_a = first_a + (a.is_leaf() ? 1 : a.child_count);
      const std::uint32_t end_b = first_b + (b.is_leaf() ? 1 : b.child_count);
      for (std::uint32_t i = first_a; i < end_a; ++i)
        for (std::uint32_t j = first_b; j < end_b; ++j) next.push_back({i, j});
    }
    std::swap(front, next);
  }
}

}  // namespace graze::tools
