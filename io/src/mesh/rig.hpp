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
  std::vector<Eigen::Vector3d> vertices;
  std::vector<MorphTarget> targets;
  std::vector<Bone> bones;  ///< empty: the node alone places the object
  std::vector<std::vector<Influence>>
      influences;  ///< for each vertex, when there are bones; none: its node's
};

/// The nodes, animations and objects of a file. Immutable once read.
struct Rig {
  std::vector<RigNode> nodes;
  std::vector<Clip> clips;
  std::vector<Body> bodies;
};

/// Computes a body's vertices at `seconds` of `clip`, or while nothing plays (null).
void pose(const Rig& rig, const Body& body, const Clip* clip, double seconds,
          std::vector<Eigen::Vector3d>& positions);

/// For each vertex, whether its node or its bones mirror the space around it while nothing plays. A face of
/// mirrored vertices is inside out.
std::vector<bool> mirrored_vertices(const Rig& rig, const Body& body);

/// Whether `clip` has keys for anything that places `body`.
bool reaches(const Rig& rig, const Clip& clip, const Body& body);

}  // namespace graze::io
