#include "examples/loops/push_constraint.hpp"

#include <algorithm>

namespace loops {
namespace {

constexpr double gap = 0.01;          // m, that surfaces keep
constexpr double recovered = 0.2;     // of the way out, in a frame
constexpr double recovery_speed = 2;  // m/s
constexpr double friction = 0.5;

/// Returns how much a push along a direction moves a prop at an arm: the inverse of a mass.
double softness(const Prop* prop, const Eigen::Vector3d& arm, const Eigen::Vector3d& direction) {
  if (prop == nullptr) return 0;
  const Eigen::Vector3d turned = arm.cross(direction);
  return prop->inverse_mass + turned.dot(prop->inverse_inertia_now * turned);
}

/// Returns a number that softness() does not exceed for any direction.
double largest_softness(const Prop* prop, const Eigen::Vector3d& arm) {
  return prop == nullptr ? 0 : prop->inverse_mass + arm.squaredNorm() * prop->inverse_inertia.maxCoeff();
}

Eigen::Vector3d velocity(const ContactSide& side, const Eigen::Vector3d& arm) {
  return side.prop == nullptr ? side.velocity : side.prop->velocity_at(arm);
}

}  // namespace

PushConstraint::PushConstraint(const graze::Contact& contact, const ContactSide& a, const ContactSide& b,
                               double time)
    : a_(a), b_(b), direction_(contact.push()) {
  if (a.prop != nullptr) arm_a_ = a.point - a.prop->position;
  if (b.prop != nullptr) arm_b_ = b.point - b.prop->position;
  const double room = contact.separation() - gap;
  speed_ = room > 0 ? -room / time : std::min(-room * recovered / time, recovery_speed);
  mass_ = 1 / (softness(a.prop, arm_a_, direction_) + softness(b.prop, arm_b_, direction_));
  sliding_mass_ = 1 / (largest_softness(a.prop, arm_a_) + largest_softness(b.prop, arm_b_));
}

void PushConstraint::push(const Eigen::Vector3d& impulse) const {
  if (a_.prop != nullptr) a_.prop->push(arm_a_, -impulse);
  if (b_.prop != nullptr) b_.prop->push(arm_b_, impulse);
}

void PushConstraint::solve() {
  Eigen::Vector3d leaving = velocity(b_, arm_b_) - velocity(a_, arm_a_);
  const double pushed = std::max(0.0, impulse_ + mass_ * (speed_ - direction_.dot(leaving)));
  push((pushed - impulse_) * direction_);
  impulse_ = pushed;

  leaving = velocity(b_, arm_b_) - velocity(a_, arm_a_);
  const Eigen::Vector3d sliding = leaving - direction_.dot(leaving) * direction_;
  Eigen::Vector3d held = friction_ - sliding_mass_ * sliding;
  const double most = friction * impulse_;
  if (held.norm() > most) held *= most / held.norm();
  push(held - friction_);
  friction_ = held;
}

}  // namespace loops
