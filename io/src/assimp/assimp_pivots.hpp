#pragma once

#include <cstdint>

#include "assimp/assimp_nodes.hpp"
#include "mesh/rig.hpp"

namespace graze::io {

/// Corrects the motion of an FBX node that has a pre-rotation or a post-rotation.
///
/// assimp spreads the rest transform of such a node over nodes above it, such as
/// `arm_$AssimpFbx$_PreRotation`. assimp 5.0.1 to 5.4 give the motion of the whole transform to the node
/// itself, so the rest transform is applied twice. They also turn by the post-rotation where FBX turns by its
/// inverse. Afterwards the motion in `clip` is right, and the nodes above stay at the identity. Other
/// versions give each of the nodes a motion of its own, and these motions are left alone.
void correct_pivots(Clip& clip, const NodeTable& nodes, std::uint32_t node);

/// The geometric transform of an FBX node, which moves its mesh and none of its children. assimp keeps it in
/// nodes above, and leaves it out of the offsets of bones (aiBone::mOffsetMatrix). The identity elsewhere.
Eigen::Affine3d geometric_transform(const NodeTable& nodes, std::uint32_t node);

}  // namespace graze::io
