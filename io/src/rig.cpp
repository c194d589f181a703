#include "rig.hpp"

#include <algorithm>

namespace graze::io {
namespace {

double between(double a, double b, double part) {
  return a + part * (b - a);
}

Eigen::Vector3d between(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double part) {
  return a + part * (b - a);
}

Eigen::Quaterniond between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double part) {
  return a.slerp(part, b);
}

template <typename Value>
Value value_at(const Track<Value>& track, double seconds, const Value& without_keys) {
  if (track.values.empty()) return without_keys;
  const auto after = std::upper_bound(track.seconds.begin(), track.seconds.end(), seconds);
  if (after == track.seconds.begin()) return track.values.front();
  const auto left = static_cast<std::size_t>(after - track.seconds.begin()) - 1;
  if (after == track.seconds.end() || track.is_stepped) return track.values[left];
  const double part = (seconds - track.seconds[left]) / (*after - track.seconds[left]);
  return between(track.values[left], track.values[left + 1], part);
}

Eigen::Affine3d local_transform(const RigNode& node, const NodeMotion& motion, double seconds) {
  Eigen::Affine3d transform;
  transform.fromPositionOrientationScale(value_at(motion.translation, seconds, node.translation),
                                         value_at(motion.rotation, seconds, node.rotation),
                                         value_at(motion.scale, seconds, node.scale));
  return transform;
}

Eigen::Affine3d local_transform(const Rig& rig, std::uint32_t node, const Clip* clip, double seconds) {
  if (clip != nullptr) {
    const auto motion = clip->node_motions.find(node);
    if (motion != clip->node_motions.end()) return local_transform(rig.nodes[node], motion->second, seconds);
  }
  return rig.nodes[node].local;
}

Eigen::Affine3d global_transform(const Rig& rig, std::uint32_t node, const Clip* clip, double seconds) {
  Eigen::Affine3d transform = local_transform(rig, node, clip, seconds);
  for (auto parent = rig.nodes[node].parent; parent != RigNode::no_parent; parent = rig.nodes[parent].parent)
    transform = local_transform(rig, parent, clip, seconds) * transform;
  return transform;
}

void add_morphs(const Body& body, const Clip* clip, double seconds, std::vector<Eigen::Vector3d>& positions) {
  const std::vector<Track<double>>* tracks = nullptr;
  if (clip != nullptr) {
    const auto found = clip->morph_weights.find(body.node);
    if (found != clip->morph_weights.end()) tracks = &found->second;
  }
  for (std::size_t target = 0; target < body.targets.size(); ++target) {
    const MorphTarget& morph = body.targets[target];
    const bool has_track = tracks != nullptr && target < tracks->size();
    const double weight =
        has_track ? value_at((*tracks)[target], seconds, morph.rest_weight) : morph.rest_weight;
    if (weight == 0) continue;
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
      positions[vertex] += weight * morph.offsets[vertex];
  }
}

/// The mean of where the vertex's bones take it, by weight; the node's place where it has none.
void apply_bones(const Rig& rig, const Body& body, const Clip* clip, double seconds,
                 const Eigen::Affine3d& global, std::vector<Eigen::Vector3d>& positions) {
  std::vector<Eigen::Affine3d> transforms;
  transforms.reserve(body.bones.size());
  for (const auto& bone : body.bones)
    transforms.push_back(global_transform(rig, bone.node, clip, seconds) * bone.offset);
  for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
    double total = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& influence : body.influences[vertex]) {
      sum += influence.weight * (transforms[influence.bone] * positions[vertex]);
      total += influence.weight;
    }
    positions[vertex] =
        total > 0 ? Eigen::Vector3d(sum / total) : Eigen::Vector3d(global * positions[vertex]);
  }
}

bool moves(const Rig& rig, const Clip& clip, std::uint32_t node) {
  for (; node != RigNode::no_parent; node = rig.nodes[node].parent)
    if (clip.node_motions.contains(node)) return true;
  return false;
}

}  // namespace

void pose(const Rig& rig, const Body& body, const Clip* clip, double seconds,
          std::vector<Eigen::Vector3d>& positions) {
  positions = body.vertices;
  add_morphs(body, clip, seconds, positions);
  const Eigen::Affine3d global = global_transform(rig, body.node, clip, seconds);
  if (body.bones.empty())
    for (auto& position : positions) position = global * position;
  else
    apply_bones(rig, body, clip, seconds, global, positions);
}

bool is_mirrored(const Rig& rig, const Body& body) {
  return body.bones.empty() && global_transform(rig, body.node, nullptr, 0).linear().determinant() < 0;
}

bool reaches(const Rig& rig, const Clip& clip, const Body& body) {
  if (!body.targets.empty() && clip.morph_weights.contains(body.node)) return true;
  const auto is_unweighted = [](const auto& influences) { return influences.empty(); };
  if (body.bones.empty() || std::any_of(body.influences.begin(), body.influences.end(), is_unweighted))
    if (moves(rig, clip, body.node)) return true;
  return std::any_of(body.bones.begin(), body.bones.end(),
                     [&](const Bone& bone) { return moves(rig, clip, bone.node); });
}

}  // namespace graze::io
