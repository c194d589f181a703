#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <graze/mesh.hpp>
#include <memory>
#include <vector>

namespace graze::scenes {

/// The paper's human on a small skeleton: arms and legs swing, forearms and shins bend, by linear blend
/// skinning with weights that fall off with the distance from each bone.
class SkinnedHuman {
 public:
  SkinnedHuman();

  [[nodiscard]] const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
  /// Calculates the positions of the vertices at `time`, in radians of a stride. The human stands at the
  /// origin.
  void pose(double time, std::vector<Eigen::Vector3d>& positions) const;

 private:
  static constexpr std::size_t bone_count = 9;

  std::shared_ptr<const Mesh> mesh_;
  std::vector<std::array<double, bone_count>> weights_;  ///< of each vertex. They sum to 1
};

}  // namespace graze::scenes
