#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <graze/graze.hpp>
#include <memory>
#include <random>

#include "examples/support/shapes.hpp"

namespace examples {

/// A rigid body without weight that turns alike about all axes, as a cube and a ball do.
struct Projectile {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< in m/s
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< in rad/s
  double radius = 0;                                   ///< in m, of the sphere about it
  double inertia = 0;                                  ///< moment of inertia by mass, in m²

  /// Returns where it is after a time, if it meets nothing.
  [[nodiscard]] Eigen::Isometry3d after(double time) const;
  /// Returns a speed that no point of it exceeds.
  [[nodiscard]] double top_speed() const { return velocity.norm() + radius * spin.norm(); }
};

/// Returns the mesh of a shape.
std::shared_ptr<const graze::Mesh> mesh_of(const Shape& shape);

/// Changes the velocity of a projectile, object b of all contacts, so that no separation falls below `skin`
/// within a time. It bounces off with 0.3 of its speed.
void respond(Projectile& body, const graze::FrameReport& report, double skin, double time);

/// Returns a projectile about 1 m above the origin that flies down, a little aside, and spins.
Projectile random_shot(double speed, double radius, double inertia, std::mt19937& random);

}  // namespace examples
