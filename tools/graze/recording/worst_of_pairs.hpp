#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <graze/io/scene_snapshot.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace graze::tools {

/// The deepest contact that a pair of objects had, and its frame.
struct DeepestPlace {
  std::string names;
  std::uint64_t frame = 0;
  double separation = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of a's surface
};

/// How far the separation of a pair changed from one frame to the next.
struct SeparationJump {
  std::string names;
  std::uint64_t frame = 0;  ///< the second of the two
  double before = 0;
  double after = 0;
};

/// Goes through the frames of a recording in their order, and keeps of each pair its deepest contact and its
/// largest jump.
///
/// The separation of a pair is that of its deepest contact. Where no contact is listed it is the upper bound
/// of the distance. A jump has a contact in one of its two frames at least.
class WorstOfPairs {
 public:
  void add(const io::SceneSnapshot& snapshot);
  /// The next frame does not follow the last one.
  void forget_last_frame() { last_.clear(); }

  /// The deepest first.
  [[nodiscard]] std::vector<DeepestPlace> deepest() const;
  /// The largest first.
  [[nodiscard]] std::vector<SeparationJump> jumps() const;

 private:
  /// Two objects, by how many were added before them.
  using Pair = std::pair<std::uint64_t, std::uint64_t>;
  struct Separation {
    double value = 0;
    bool has_contact = false;
  };

  void add_contact(const Pair& pair, const DeepestPlace& place);
  void add_jump(const Pair& pair, const SeparationJump& jump);

  std::map<Pair, Separation> last_;  ///< of the last frame
  std::map<Pair, DeepestPlace> deepest_;
  std::map<Pair, SeparationJump> jumps_;
};

}  // namespace graze::tools
