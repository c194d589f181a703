#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "bench/soft_bodies/soft_contacts.hpp"
#include "examples/support/world.hpp"

namespace graze::bench {

/// A scene of soft bodies for the solver of the examples.
struct SoftBodyScene {
  std::string name;
  examples::WorldSettings settings;
  int steps_per_frame = 1;  ///< each with one look for contacts
  /// Adds the bodies, and returns what each of them is.
  std::vector<SoftBodyKind> (*fill)(examples::World& world) = nullptr;
  /// Sets the velocities of bodies that nothing pushes, at the beginning of a frame of 1/60 s.
  void (*lead)(examples::World& world, std::size_t frame) = [](examples::World&, std::size_t) {};
  /// Whether a vertex of what is not fixed has left the scene.
  bool (*is_out)(const Eigen::Vector3d& point) = [](const Eigen::Vector3d&) { return false; };
  /// The margins of Bullet's soft bodies to compare, in m. These are the best ones for balls.
  std::vector<double> margins{0.005, 0.01};
};

inline constexpr double frame_time = 1.0 / 60;  // s

/// Returns the scene with another number of steps in a frame, and as many substeps of the solver as before in
/// all of them together.
SoftBodyScene with_steps(SoftBodyScene scene, int steps_per_frame);

/// A cloth that falls over a ball, as in tools/examples/cloth_on_sphere.cpp.
SoftBodyScene cloth_on_ball();

/// Soft balls that fall into a bowl, as in tools/examples/bowl.cpp, but only 20 of them.
SoftBodyScene balls_in_bowl();

/// Twenty such balls fall into a tray of five boxes.
SoftBodyScene balls_in_tray();

/// Two soft balls that start half inside each other, as in tools/examples/recovery.cpp.
SoftBodyScene balls_inside_each_other();

}  // namespace graze::bench
