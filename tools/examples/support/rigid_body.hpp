#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <graze/graze.hpp>

namespace examples {

/// A rigid body whose inertia is the same about each axis, as that of a cube or a ball is. Its middle is the
/// origin of its mesh. An inverse mass and an inverse inertia of 0 are those of the ground.
struct RigidBody {
  graze::ObjectId id;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double inverse_mass = 0;     ///< 1/kg
  double inverse_inertia = 0;  ///< 1/(kg m²)
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< angular velocity, in 1/s

  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& arm) const;
  /// Changes the velocities by an impulse that acts at an arm from the middle.
  void push(const Eigen::Vector3d& impulse, const Eigen::Vector3d& arm);
  /// Moves the pose by the velocities.
  void move(double time_step);
};

/// How contacts of rigid bodies push.
struct RigidContactSettings {
  double gap = 0.002;           ///< m, how far surfaces stay apart; less than the contact distance
  double friction = 0.5;        ///< the coefficient of Coulomb's friction
  double recovery_speed = 0.5;  ///< m/s, how fast what is too near is pushed out at most
};

/// A contact of two rigid bodies that pushes by impulses. It keeps what it has pushed so far in a step, so
/// that it never pulls, and so that friction stays below its limit.
class RigidContact {
 public:
  RigidContact(RigidBody& a, RigidBody& b, const graze::Contact& contact,
               const RigidContactSettings& settings, double time_step);

  /// Corrects the velocities of both bodies. Calls for all contacts in turn come nearer to what suits all.
  void solve();

 private:
  [[nodiscard]] Eigen::Vector3d relative_velocity() const;
  [[nodiscard]] double inverse_mass(const Eigen::Vector3d& along) const;
  void apply(const Eigen::Vector3d& impulse);

  RigidBody* a_;
  RigidBody* b_;
  Eigen::Vector3d arm_a_;  ///< from the middle of the body to the contact
  Eigen::Vector3d arm_b_;
  Eigen::Vector3d direction_;
  double wanted_speed_;  ///< of b relative to a along the direction, at least
  double friction_;
  double pressure_ = 0;                             ///< the impulse along the direction
  Eigen::Vector3d drag_ = Eigen::Vector3d::Zero();  ///< the impulse of friction
};

}  // namespace examples
