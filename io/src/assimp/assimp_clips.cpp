#include "assimp/assimp_clips.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "assimp/assimp_convert.hpp"
#include "assimp/assimp_pivots.hpp"

namespace graze::io {
namespace {

template <typename Value>
void add_key(Track<Value>& track, double seconds, const Value& value) {
  if (!std::isfinite(seconds)) return;
  track.values.push_back(value);
  track.seconds.push_back(seconds);
}

/// Puts the keys of a track into order of time. Keys of one time stay in the order of the file.
template <typename Value>
void sort_keys(Track<Value>& track) {
  if (std::ranges::is_sorted(track.seconds)) return;
  std::vector<std::size_t> order(track.seconds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t key) { return track.seconds[key]; });
  Track<Value> sorted;
  for (const std::size_t key : order) add_key(sorted, track.seconds[key], track.values[key]);
  track = std::move(sorted);
}

Track<Eigen::Vector3d> read_track(const aiVectorKey* keys, unsigned count, double seconds_per_tick) {
  Track<Eigen::Vector3d> track;
  for (unsigned i = 0; i < count; ++i) {
    const Eigen::Vector3d value = to_eigen(keys[i].mValue);
    if (value.allFinite()) add_key(track, keys[i].mTime * seconds_per_tick, value);
  }
  sort_keys(track);
  return track;
}

Track<Eigen::Quaterniond> read_track(const aiQuatKey* keys, unsigned count, double seconds_per_tick) {
  Track<Eigen::Quaterniond> track;
  for (unsigned i = 0; i < count; ++i) {
    const Eigen::Quaterniond value = to_eigen(keys[i].mValue);
    const double norm = value.norm();
    if (norm > 0 && std::isfinite(norm)) add_key(track, keys[i].mTime * seconds_per_tick, value.normalized());
  }
  sort_keys(track);
  return track;
}

/// A key names the targets it is for. (FBX has keys for some of them only.)
std::vector<Track<double>> read_morph_tracks(const aiMeshMorphAnim& source, double seconds_per_tick,
                                             unsigned most_targets) {
  std::vector<Track<double>> tracks;
  for (unsigned i = 0; i < source.mNumKeys; ++i) {
    const aiMeshMorphKey& key = source.mKeys[i];
    for (unsigned j = 0; j < key.mNumValuesAndWeights; ++j) {
      const unsigned target = key.mValues[j];
      if (target >= most_targets || !std::isfinite(key.mWeights[j])) continue;
      if (target >= tracks.size()) tracks.resize(target + 1);
      add_key(tracks[target], key.mTime * seconds_per_tick, key.mWeights[j]);
    }
  }
  for (auto& track : tracks) sort_keys(track);
  return tracks;
}

/// The node that morph weights are for: assimp's FBX reader adds "*" and a number to its name.
std::optional<std::uint32_t> find_morphed(const NodeTable& nodes, const std::string& name) {
  const auto exact = nodes.find(name);
  return exact ? exact : nodes.find(name.substr(0, name.rfind('*')));
}

template <typename Value>
void extend(double& seconds, const Track<Value>& track) {
  if (!track.seconds.empty()) seconds = std::max(seconds, track.seconds.back());
}

double last_key(const Clip& clip) {
  double seconds = 0;
  for (const auto& [node, motion] : clip.node_motions) {
    extend(seconds, motion.translation);
    extend(seconds, motion.rotation);
    extend(seconds, motion.scale);
  }
  for (const auto& [node, tracks] : clip.morph_weights)
    for (const auto& track : tracks) extend(seconds, track);
  return seconds;
}

class ClipReader {
 public:
  ClipReader(const aiScene& scene, const aiAnimation& source, const NodeTable& nodes)
      : scene_(scene),
        source_(source),
        nodes_(nodes),
        seconds_per_tick_(1.0 /
                          (source.mTicksPerSecond > 0 ? source.mTicksPerSecond : default_ticks_per_second)) {}

  Clip read() {
    clip_.name = source_.mName.C_Str();
    for (unsigned i = 0; i < source_.mNumChannels; ++i) read_node(*source_.mChannels[i]);
    for (unsigned i = 0; i < source_.mNumMorphMeshChannels; ++i) read_morphs(*source_.mMorphMeshChannels[i]);
    clip_.seconds = source_.mDuration * seconds_per_tick_;
    if (!(clip_.seconds > 0) || !std::isfinite(clip_.seconds)) clip_.seconds = last_key(clip_);
    return std::move(clip_);
  }

 private:
  static constexpr double default_ticks_per_second = 25;

  void read_node(const aiNodeAnim& channel) {
    const std::string name = channel.mNodeName.C_Str();
    const auto node = nodes_.find(name);
    if (!node) return;
    NodeMotion& motion = clip_.node_motions[*node];
    motion.translation = read_track(channel.mPositionKeys, channel.mNumPositionKeys, seconds_per_tick_);
    motion.rotation = read_track(channel.mRotationKeys, channel.mNumRotationKeys, seconds_per_tick_);
    motion.scale = read_track(channel.mScalingKeys, channel.mNumScalingKeys, seconds_per_tick_);
    correct_pivots(clip_, nodes_, *node);
  }

  void read_morphs(const aiMeshMorphAnim& channel) {
    const std::string name = channel.mName.C_Str();
    const auto node = find_morphed(nodes_, name);
    if (!node) return;
    clip_.morph_weights[*node] = read_morph_tracks(channel, seconds_per_tick_, target_count(*node));
  }

  /// How many morph targets the meshes of a node have.
  [[nodiscard]] unsigned target_count(std::uint32_t node) const {
    unsigned count = 0;
    for (const unsigned mesh : std::span(nodes_.sources[node]->mMeshes, nodes_.sources[node]->mNumMeshes))
      if (mesh < scene_.mNumMeshes) count = std::max(count, scene_.mMeshes[mesh]->mNumAnimMeshes);
    return count;
  }

  const aiScene& scene_;
  const aiAnimation& source_;
  const NodeTable& nodes_;
  double seconds_per_tick_;
  Clip clip_;
};

}  // namespace

std::vector<Clip> read_clips(const aiScene& scene, const NodeTable& nodes) {
  std::vector<Clip> clips;
  for (unsigned i = 0; i < scene.mNumAnimations; ++i)
    clips.push_back(ClipReader(scene, *scene.mAnimations[i], nodes).read());
  return clips;
}

}  // namespace graze::io
