#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <graze/graze.hpp>

/// Rigid bodies, and a solver that moves their poses. It shows how contacts of graze carry bodies, and plays
/// the contacts of others in the same way. Lengths are in m, masses in kg and times in s.
namespace graze::rigid {

/// Mass, centre of mass, and the inertia about that centre, in kg m².
struct MassProperties {
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// Computes what a closed mesh weighs whose inside has the given density, in kg/m³. Faces are wound outward.
/// Boxes, logs and balls have what their meshes have.
[[nodiscard]] MassProperties mass_of(const Mesh& mesh, double density);

/// One rigid body. The origin of its own coordinates is its centre of mass. A body with an inverse mass and
/// an inverse inertia of 0 stands still, or moves as its velocities say and nothing pushes it.
struct Body {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();             ///< angular velocity, in rad/s
  double inverse_mass = 0;                                    ///< 1/kg
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();  ///< 1/(kg m²), in the body's own coordinates

  /// Sets the inverse mass and inertia. The centre has to be the origin.
  void set_mass(const MassProperties& properties);

  [[nodiscard]] Eigen::Isometry3d pose() const;
  void set_pose(const Eigen::Isometry3d& pose);
  /// Returns where a point of the body's own coordinates is in the world.
  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& point) const;
  /// Returns a point of the world in the body's own coordinates.
  [[nodiscard]] Eigen::Vector3d to_own(const Eigen::Vector3d& point) const;
  /// Returns the velocity of the point that is at an arm, in world directions, from the centre.
  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& arm) const;
  /// Returns how far an impulse along a direction of length 1, at an arm from the centre, speeds that point
  /// up along the direction, in 1/kg.
  [[nodiscard]] double yielding(const Eigen::Vector3d& arm, const Eigen::Vector3d& along) const;

  /// Moves position and turn by an impulse of positions (kg m) that acts at an arm from the centre.
  void shift(const Eigen::Vector3d& impulse, const Eigen::Vector3d& arm);
  /// Changes velocity and spin by an impulse (kg m/s) that acts at an arm from the centre.
  void push(const Eigen::Vector3d& impulse, const Eigen::Vector3d& arm);
  /// Changes the turn by a small rotation: an axis in world directions times an angle in rad.
  void rotate(const Eigen::Vector3d& rotation);

 private:
  /// Multiplies by the inverse inertia in world directions.
  [[nodiscard]] Eigen::Vector3d inertia_solved(const Eigen::Vector3d& torque) const;
};

}  // namespace graze::rigid
