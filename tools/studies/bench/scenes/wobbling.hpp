#pragma once

#include <graze/mesh.hpp>
#include <memory>

#include "bench/scenes/scenes.hpp"

namespace graze::bench {

/// A way through a scene: the rest shape is turned once, moved along a Lissajous path about `centre`, and
/// swells and shrinks in waves along its own z axis.
struct Path {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d reach = Eigen::Vector3d::Zero();  ///< amplitude along each axis
  Eigen::Vector3d speed = Eigen::Vector3d::Zero();  ///< radians a frame
  double phase = 0;
  double wobble = 0;  ///< relative to the radius
};

Body wobbling(std::shared_ptr<const Mesh> mesh, const Path& path);

}  // namespace graze::bench
