#include "assimp/assimp_pivots.hpp"

#include <Eigen/LU>
#include <string_view>
#include <vector>

namespace graze::io {
namespace {

/// What assimp spread over the nodes above a node: T · Rpre · R · Rpost⁻¹ · S at rest.
struct PivotNodes {
  std::vector<std::uint32_t> nodes;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond pre_rotation = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond inverse_post_rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();

  /// Takes a node's part, and returns false for a part that no motion of the whole transform has.
  bool take(std::string_view part, const RigNode& source) {
    if (part == "Translation")
      translation = source.translation;
    else if (part == "PreRotation")
      pre_rotation = source.rotation;
    else if (part == "Rotation")
      rotation = source.rotation;
    else if (part == "PostRotation")
      inverse_post_rotation = source.rotation;
    else if (part == "Scaling")
      scale = source.local.linear().diagonal();
    else
      return false;
    return true;
  }
};

/// Visits the nodes above that hold parts of the node's transform, from the last part to the first.
template <typename Visit>
void visit_parts(const NodeTable& nodes, std::uint32_t node, const Visit& visit) {
  const std::string beginning = std::string(nodes.sources[node]->mName.C_Str()) + "_$AssimpFbx$_";
  for (auto above = nodes.nodes[node].parent; above != RigNode::no_parent;
       above = nodes.nodes[above].parent) {
    const std::string_view name = nodes.sources[above]->mName.C_Str();
    if (!name.starts_with(beginning)) return;
    visit(name.substr(beginning.size()), above);
  }
}

PivotNodes find_pivots(const NodeTable& nodes, std::uint32_t node) {
  PivotNodes found;
  visit_parts(nodes, node, [&](std::string_view part, std::uint32_t above) {
    if (found.take(part, nodes.nodes[above])) found.nodes.push_back(above);
  });
  return found;
}

/// assimp takes a scale with an odd number of negative axes as negative on all three, and one with two
/// negative axes as positive. What is left of the signs is a half turn in the rotation.
Eigen::Quaterniond half_turn_of(const Eigen::Vector3d& scale) {
  Eigen::Vector3d signs = scale.unaryExpr([](double number) { return number < 0 ? -1.0 : 1.0; });
  if (signs.prod() < 0) signs = -signs;
  return Eigen::Quaterniond(Eigen::Matrix3d(signs.asDiagonal()));
}

template <typename Value>
Track<Value> constant_track(const Value& value) {
  Track<Value> track;
  track.seconds = {0.0};
  track.values = {value};
  return track;
}

NodeMotion no_motion() {
  return {constant_track<Eigen::Vector3d>(Eigen::Vector3d::Zero()),
          constant_track<Eigen::Quaterniond>(Eigen::Quaterniond::Identity()),
          constant_track<Eigen::Vector3d>(Eigen::Vector3d::Ones())};
}

}  // namespace

void correct_pivots(Clip& clip, const NodeTable& nodes, std::uint32_t node) {
  const PivotNodes pivots = find_pivots(nodes, node);
  if (pivots.nodes.empty()) return;
  NodeMotion& motion = clip.node_motions[node];
  const Eigen::Quaterniond half_turn = half_turn_of(pivots.scale);
  const Eigen::Quaterniond correction =
      half_turn.conjugate() * pivots.inverse_post_rotation * pivots.inverse_post_rotation * half_turn;
  for (Eigen::Quaterniond& rotation : motion.rotation.values) rotation = (rotation * correction).normalized();
  if (motion.translation.values.empty())
    motion.translation = constant_track<Eigen::Vector3d>(pivots.translation);
  if (motion.rotation.values.empty())
    motion.rotation = constant_track<Eigen::Quaterniond>(pivots.pre_rotation * pivots.rotation *
                                                         pivots.inverse_post_rotation);
  if (motion.scale.values.empty()) motion.scale = constant_track<Eigen::Vector3d>(pivots.scale);
  for (const std::uint32_t pivot : pivots.nodes) clip.node_motions[pivot] = no_motion();
}

Eigen::Affine3d geometric_transform(const NodeTable& nodes, std::uint32_t node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  visit_parts(nodes, node, [&](std::string_view part, std::uint32_t above) {
    if (part.starts_with("Geometric")) transform = nodes.nodes[above].local * transform;
  });
  return transform;
}

}  // namespace graze::io
