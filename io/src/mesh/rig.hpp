#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

namespace graze::io {

/// How a track goes from one key to the next: along a straight line (rotations along the shorter arc), not
/// before the next key, or along a cubic Hermite spline.
enum class Interpolation : std::uint8_t { linear, step, cubic };

/// Values at ascending times. Before the first and after the last they hold. Empty where nothing is animated.
template <typename Value>
struct Track {
  std::vector<double> seconds;
  std::vector<Value> values;
  /// The slopes before and after each key, by the second. Only cubic tracks have them.
  std::vector<Value> in_tangents;
  std::vector<Value> out_tangents;
  Interpolation interpolation = Interpolation::linear;
};

/// The motion of one node in an animation. A part without keys keeps the node's own value.
struct NodeMotion {
  Track<Eigen::Vector3d> translation;
  Track<Eigen::Quaterniond> rotation;
  Track<Eigen::Vector3d> scale;
};

struct Clip {
  std::string name;
  double seconds = 0;
  std::unordered_map<std::uint32_t, NodeMotion> node_motions;  ///< by node
  std::unordered_map<std::uint32_t, std::vector<Track<double>>>
      morph_weights;  ///< by node, then by morph target
};

struct RigNode {
  static constexpr std::uint32_t no_parent = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t parent = no_parent;  ///< a lower number
  Eigen::Affine3d local = Eigen::Affine3d::Identity();
  /// The parts of `local`: translation, rotation and scale.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
};

struct Bone {
  std::uint32_t node = 0;
  Eigen::Affine3d offset = Eigen::Affine3d::Identity();  ///< from the object's space to the bone's
};

struct Influence {
  std::uint32_t bone = 0;
  double weight = 0;

  friend bool operator==(const Influence&, const Influence&) = default;
};

struct MorphTarget {
  std::vector<Eigen::Vector3d> offsets;  ///< one for each vertex
  double rest_weight = 0;
};

/// An object before its node, its skeleton and its morph targets place it.
struct Body {
  std::uint32_t node = 0;
  std::uint32_t morph_node = 0;  ///< whose morph weights count
  std::vector<Eigen::Vector3d> vertices;
  std::vector<MorphTarget> targets;
  std::vector<Bone> bones;  ///< empty: the node alone places the object
  std::vector<std::vector<Influence>>
      influences;  ///< for each vertex, when there are bones. Where there are none, its node's
};

/// The nodes, animations and objects of a file. Immutable once read.
struct Rig {
  std::vector<RigNode> nodes;
  std::vector<Clip> clips;
  std::vector<Body> bodies;
};

/// Where the nodes of a rig are at one time of a clip, or while nothing plays (null). A node that many bodies
/// and bones ask for is computed once.
class NodePlaces {
 public:
  /// Both must outlive it.
  NodePlaces(const Rig& rig, const Clip* clip, double seconds) : rig_(rig), clip_(clip), seconds_(seconds) {}

  [[nodiscard]] const Rig& rig() const { return rig_; }
  [[nodiscard]] const Clip* clip() const { return clip_; }
  [[nodiscard]] double seconds() const { return seconds_; }
  /// From the node's space to that of the file.
  const Eigen::Affine3d& of(std::uint32_t node);

 private:
  const Rig& rig_;
  const Clip* clip_;
  double seconds_;
  std::unordered_map<std::uint32_t, Eigen::Affine3d> places_;
};

/// Computes a body's vertices where the nodes are at `places`.
void pose(NodePlaces& places, const Body& body, std::vector<Eigen::Vector3d>& positions);
/// Computes a body's vertices at `seconds` of `clip`, or while nothing plays (null).
void pose(const Rig& rig, const Body& body, const Clip* clip, double seconds,
          std::vector<Eigen::Vector3d>& positions);

/// For each vertex, whether its node or its bones mirror the space around it while nothing plays. A face of
/// mirrored vertices is inside out. `rest` is of no clip.
std::vector<bool> mirrored_vertices(NodePlaces& rest, const Body& body);

/// What the clips of a rig move.
class MovedNodes {
 public:
  explicit MovedNodes(const Rig& rig);

  /// Whether a clip has keys for anything that places `body`.
  [[nodiscard]] bool move(const Body& body) const;

 private:
  std::vector<bool> is_moved_;    ///< itself or by a node above it
  std::vector<bool> is_morphed_;  ///< has keys of morph weights
};

}  // namespace graze::io
