#pragma once

#include <graze/mesh.hpp>

#include "experiment/regions/partitions/binary_tree.hpp"

namespace graze::tools {

/// The tree of a mesh's edge collapses. Every vertex is a region at first. Again and again the edge collapses
/// whose two regions together spread least more about their mean than they do apart. This is Ward's measure:
/// the product of their vertex counts over its sum, times the squared distance of their means. Components
/// that no edge joins are joined at last, the first with the next.
BinaryTree collapsed(const Mesh& mesh);

}  // namespace graze::tools
