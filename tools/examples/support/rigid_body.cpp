#include "examples/support/rigid_body.hpp"

#include <algorithm>
#include <utility>

namespace examples {
namespace {

/// Contacts nearer than the gap are pushed out slowly. Those further away may come as near as the gap.
double speed_for(double separation, const RigidContactSettings& settings, double time_step) {
  const double speed = (settings.gap - separation) / time_step;
  return speed > 0 ? std::min(0.2 * speed, settings.recovery_speed) : speed;
}

}  // namespace

Eigen::Vector3d RigidBody::velocity_at(const Eigen::Vector3d& arm) const {
  return velocity + spin.cross(arm);
}

void RigidBody::push(const Eigen::Vector3d& impulse, const Eigen::Vector3d& arm) {
  velocity += inverse_mass * impulse;
  spin += inverse_inertia * arm.cross(impulse);
}

void RigidBody::move(double time_step) {
  pose.translation() += time_step * velocity;
  const double angle = time_step * spin.norm();
  if (angle > 0) pose.linear() = Eigen::AngleAxisd(angle, spin.normalized()) * pose.linear();
}

RigidContact::RigidContact(RigidBody& a, RigidBody& b, const graze::Contact& contact,
                           const RigidContactSettings& settings, double time_step)
    : a_(&a),
      b_(&b),
      arm_a_(contact.point_a - a.pose.translation()),
      arm_b_(contact.point_b - b.pose.translation()),
      direction_(contact.push()),
      wanted_speed_(speed_for(contact.separation(), settings, time_step)),
      friction_(settings.friction) {}

Eigen::Vector3d RigidContact::relative_velocity() const {
  return b_->velocity_at(arm_b_) - a_->velocity_at(arm_a_);
}

double RigidContact::inverse_mass(const Eigen::Vector3d& along) const {
  return a_->inverse_mass + b_->inverse_mass + a_->inverse_inertia * arm_a_.cross(along).squaredNorm() +
         b_->inverse_inertia * arm_b_.cross(along).squaredNorm();
}

void RigidContact::apply(const Eigen::Vector3d& impulse) {
  a_->push(-impulse, arm_a_);
  b_->push(impulse, arm_b_);
}

void RigidContact::solve() {
  const double missing = wanted_speed_ - direction_.dot(relative_velocity());
  const double pressure = std::max(0.0, pressure_ + missing / inverse_mass(direction_));
  apply((pressure - std::exchange(pressure_, pressure)) * direction_);

  const Eigen::Vector3d velocity = relative_velocity();
  const Eigen::Vector3d sliding = velocity - direction_.dot(velocity) * direction_;
  if (sliding.norm() < 1e-12) return;
  Eigen::Vector3d drag = drag_ - sliding / inverse_mass(sliding.normalized());
  drag *= std::min(1.0, friction_ * pressure_ / std::max(drag.norm(), 1e-30));
  apply(drag - std::exchange(drag_, drag));
}

}  // namespace examples
