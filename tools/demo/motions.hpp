#pragma once

#include <Eigen/Core>

namespace graze::demo {

/// How many frames the demonstration lasts.
constexpr int frame_count = 120;

/// Returns the position of a point of the paper's torus in a frame. The torus is a soft ring that falls on
/// the bull's back, gives way, wobbles and leaps off.
Eigen::Vector3d ring_point(const Eigen::Vector3d& rest, int frame);

/// Returns the position of a point of the paper's tooth in a frame. The tooth is a jelly that swings against
/// the bull's flank and shivers.
Eigen::Vector3d jelly_point(const Eigen::Vector3d& rest, int frame);

}  // namespace graze::demo
