#pragma once

#include <cstdint>
#include <graze/mesh.hpp>

#include "core/mesh/region_tree.hpp"
#include "experiment/regions/partitions/region_hierarchy.hpp"

namespace graze::tools {

/// Ways to divide a mesh's vertices into regions.
enum class Partition : std::uint8_t {
  octree,          ///< the library's own: eight equal boxes of a region's box
  median,          ///< halves of equal vertex count across the longest side: a control
  surface_halves,  ///< halves of equal vertex count by the distance along the surface from two far ends
  edge_collapse,   ///< bottom up: of two adjacent regions those merge first that stay the most compact
};

inline constexpr Partition all_partitions[] = {Partition::octree, Partition::median,
                                               Partition::surface_halves, Partition::edge_collapse};

/// As tables and figures call it.
const char* name_of(Partition partition);

/// The mesh's used vertices, divided. The three that are no octree make a binary tree, of which each region
/// takes the largest descendants as its children until they are eight. Leaves have at most `capacity`
/// vertices. Those of the octree always have RegionTree::leaf_capacity.
ClusterTree divide(const Mesh& mesh, Partition partition, std::uint32_t capacity = RegionTree::leaf_capacity);

}  // namespace graze::tools
