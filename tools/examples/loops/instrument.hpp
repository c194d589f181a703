#pragma once

#include <Eigen/Geometry>

#include "examples/loops/shape.hpp"

namespace loops {

/// A rigid instrument: a rod with a round tip, led by a hand along a path that is always the same.
class Instrument {
 public:
  /// The tip works about a point of an organ's surface. `outward` leads away from the organ there.
  Instrument(const Eigen::Vector3d& target, const Eigen::Vector3d& outward, double phase);

  /// Returns where the hand holds the instrument at a time in seconds. It presses in and lets go, slides to
  /// and fro, and trembles. Any thread may call it.
  [[nodiscard]] Eigen::Isometry3d pose(double time) const;

  [[nodiscard]] const std::shared_ptr<const graze::Mesh>& mesh() const { return mesh_; }

 private:
  std::shared_ptr<const graze::Mesh> mesh_;
  Eigen::Vector3d target_;
  Eigen::Matrix3d axes_;  ///< two directions along the surface, and the one outward
  double phase_;
};

}  // namespace loops
