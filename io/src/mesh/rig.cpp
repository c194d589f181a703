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

void add_morphs(const Body& body, const Clip* clip, double seconds, std::vector<Eigen::Vector3d>& positions) {
  const std::vector<Track<double>>* tracks = nullptr;
  if (clip != nullptr) {
    const auto found = clip->morph_weights.find(body.morph_node);
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

/// The mean of where the vertex's bones take it, by weight. It is the node's place where it has none.
void apply_bones(NodePlaces& places, const Body& body, std::vector<Eigen::Vector3d>& positions) {
  std::vector<Eigen::Affine3d> transforms;
  transforms.reserve(body.bones.size());
  for (const auto& bone : body.bones) transforms.emplace_back(places.of(bone.node) * bone.offset);
  const Eigen::Affine3d& global = places.of(body.node);
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

}  // namespace

const Eigen::Affine3d& NodePlaces::of(std::uint32_t node) {
  std::vector<std::uint32_t> unknown;
  auto known = places_.end();
  for (; node != RigNode::no_parent; node = rig_.nodes[node].parent) {
    known = places_.find(node);
    if (known != places_.end()) break;
    unknown.push_back(node);
  }
  while (!unknown.empty()) {
    const Eigen::Affine3d local = local_transform(rig_, unknown.back(), clip_, seconds_);
    const Eigen::Affine3d place = known == places_.end() ? local : Eigen::Affine3d(known->second * local);
    known = places_.emplace(unknown.back(), place).first;
    unknown.pop_back();
  }
  return known->second;
}

void pose(NodePlaces& places, const Body& body, std::vector<Eigen::Vector3d>& positions) {
  positions = body.vertices;
  add_morphs(body, places.clip(), places.seconds(), positions);
  if (!body.bones.empty()) return apply_bones(places, body, positions);
  const Eigen::Affine3d& global = places.of(body.node);
  for (auto& position : positions) position = global * position;
}

void pose(const Rig& rig, const Body& body, const Clip* clip, double seconds,
          std::vector<Eigen::Vector3d>& positions) {
  NodePlaces places(rig, clip, seconds);
  pose(places, body, positions);
}

std::vector<bool> mirrored_vertices(NodePlaces& rest, const Body& body) {
  const bool by_node = rest.of(body.node).linear().determinant() < 0;
  std::vector<bool> mirrored(body.vertices.size(), by_node);
  if (body.bones.empty()) return mirrored;
  std::vector<Eigen::Matrix3d> transforms;
  for (const Bone& bone : body.bones) transforms.emplace_back((rest.of(bone.node) * bone.offset).linear());
  for (std::size_t vertex = 0; vertex < body.vertices.size(); ++vertex) {
    if (body.influences[vertex].empty()) continue;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Influence& influence : body.influences[vertex])
      sum += influence.weight * transforms[influence.bone];
    mirrored[vertex] = sum.determinant() < 0;
  }
  return mirrored;
}

MovedNodes::MovedNodes(const Rig& rig) : is_moved_(rig.nodes.size()), is_morphed_(rig.nodes.size()) {
  for (const Clip& clip : rig.clips) {
    for (const auto& [node, motion] : clip.node_motions) is_moved_[node] = true;
    for (const auto& [node, tracks] : clip.morph_weights) is_morphed_[node] = true;
  }
  for (std::size_t node = 0; node < rig.nodes.size(); ++node) {
    const std::uint32_t parent = rig.nodes[node].parent;
    if (parent != RigNode::no_parent && is_moved_[parent]) is_moved_[node] = true;
  }
}

bool MovedNodes::move(const Body& body) const {
  if (!body.targets.empty() && is_morphed_[body.morph_node]) return true;
  const auto is_unweighted = [](const auto& influences) { return influences.empty(); };
  if (body.bones.empty() || std::ranges::any_of(body.influences, is_unweighted))
    if (is_moved_[body.node]) return true;
  return std::ranges::any_of(body.bones, [&](const Bone& bone) { return is_moved_[bone.node]; });
}

}  // namespace graze::io
