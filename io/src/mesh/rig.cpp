#include "mesh/rig.hpp"

#include <algorithm>
#include <cmath>

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

double scaled(double tangent, double span) {
  return span * tangent;
}

Eigen::Vector3d scaled(const Eigen::Vector3d& tangent, double span) {
  return span * tangent;
}

Eigen::Quaterniond scaled(const Eigen::Quaterniond& tangent, double span) {
  return Eigen::Quaterniond(Eigen::Vector4d(span * tangent.coeffs()));
}

/// The weights of a cubic Hermite spline at `part` of the way between two keys.
struct Hermite {
  double from, from_tangent, to, to_tangent;

  explicit Hermite(double part)
      : from(part * part * (2 * part - 3) + 1),
        from_tangent(part * (part * (part - 2) + 1)),
        to(part * part * (3 - 2 * part)),
        to_tangent(part * part * (part - 1)) {}

  template <typename Value>
  [[nodiscard]] Value mix(const Value& a, const Value& a_tangent, const Value& b,
                          const Value& b_tangent) const {
    return from * a + from_tangent * a_tangent + to * b + to_tangent * b_tangent;
  }
};

double spline(const Hermite& h, double a, double a_tangent, double b, double b_tangent) {
  return h.mix(a, a_tangent, b, b_tangent);
}

Eigen::Vector3d spline(const Hermite& h, const Eigen::Vector3d& a, const Eigen::Vector3d& a_tangent,
                       const Eigen::Vector3d& b, const Eigen::Vector3d& b_tangent) {
  return h.mix<Eigen::Vector3d>(a, a_tangent, b, b_tangent);
}

Eigen::Quaterniond spline(const Hermite& h, const Eigen::Quaterniond& a, const Eigen::Quaterniond& a_tangent,
                          const Eigen::Quaterniond& b, const Eigen::Quaterniond& b_tangent) {
  const Eigen::Quaterniond mixed(
      h.mix<Eigen::Vector4d>(a.coeffs(), a_tangent.coeffs(), b.coeffs(), b_tangent.coeffs()));
  const double norm = mixed.norm();
  return norm > 0 && std::isfinite(norm) ? mixed.normalized() : a;
}

template <typename Value>
Value value_at(const Track<Value>& track, double seconds, const Value& without_keys) {
  if (track.values.empty()) return without_keys;
  const auto after = std::upper_bound(track.seconds.begin(), track.seconds.end(), seconds);
  if (after == track.seconds.begin()) return track.values.front();
  const auto left = static_cast<std::size_t>(after - track.seconds.begin()) - 1;
  if (after == track.seconds.end() || track.interpolation == Interpolation::step) return track.values[left];
  const double span = *after - track.seconds[left];
  const double part = (seconds - track.seconds[left]) / span;
  if (track.interpolation == Interpolation::cubic)
    return spline(Hermite(part), track.values[left], scaled(track.out_tangents[left], span),
                  track.values[left + 1], scaled(track.in_tangents[left + 1], span));
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

std::vector<bool> mirrored_vertices(const Rig& rig, const Body& body) {
  const bool by_node = global_transform(rig, body.node, nullptr, 0).linear().determinant() < 0;
  std::vector<bool> mirrored(body.vertices.size(), by_node);
  if (body.bones.empty()) return mirrored;
  std::vector<Eigen::Matrix3d> transforms;
  for (const Bone& bone : body.bones)
    transforms.push_back((global_transform(rig, bone.node, nullptr, 0) * bone.offset).linear());
  for (std::size_t vertex = 0; vertex < body.vertices.size(); ++vertex) {
    if (body.influences[vertex].empty()) continue;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Influence& influence : body.influences[vertex])
      sum += influence.weight * transforms[influence.bone];
    mirrored[vertex] = sum.determinant() < 0;
  }
  return mirrored;
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
