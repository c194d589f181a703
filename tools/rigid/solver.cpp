#include "rigid/solver.hpp"

#include <algorithm>
#include <cstddef>

namespace graze::rigid {
namespace {

/// Returns the spin that leads from one turn to another in a time.
Eigen::Vector3d spin_between(const Eigen::Quaterniond& before, const Eigen::Quaterniond& now, double time) {
  const Eigen::Quaterniond change = now * before.conjugate();
  return (change.w() < 0 ? -2 : 2) / time * change.vec();
}

/// Changes the spin as no torque does: a body whose inertia differs from axis to axis tumbles.
void tumble(Body& body, double time_step) {
  const Eigen::Matrix3d inertia = body.inverse_inertia.inverse();
  const Eigen::Vector3d spin = body.turn.conjugate() * body.spin;
  const Eigen::Vector3d change = body.inverse_inertia * spin.cross(inertia * spin);
  body.spin -= time_step * (body.turn * change);
}

/// Removes the part of the velocity along the push that only came from pushing out. What the bodies had
/// before they keep, and nothing draws them together.
template <typename Constraint>
void calm(const Constraint& constraint) {
  const double opening = constraint.opening_speed();
  const double wanted = std::clamp(opening, 0.0, std::max(0.0, constraint.opening));
  const Eigen::Vector3d impulse = (wanted - opening) / constraint.yielding(constraint.push) * constraint.push;
  constraint.a->push(-impulse, constraint.arm_a());
  constraint.b->push(impulse, constraint.arm_b());
}

}  // namespace

Eigen::Vector3d Solver::Constraint::apart() const {
  return b->to_world(own_b) - a->to_world(own_a);
}

double Solver::Constraint::opening_speed() const {
  return push.dot(b->velocity_at(arm_b()) - a->velocity_at(arm_a()));
}

double Solver::Constraint::yielding(const Eigen::Vector3d& along) const {
  return a->yielding(arm_a(), along) + b->yielding(arm_b(), along);
}

void Solver::Constraint::shift(const Eigen::Vector3d& impulse) const {
  a->shift(-impulse, arm_a());
  b->shift(impulse, arm_b());
}

void Solver::step(std::vector<Body>& bodies, ContactSource& source, double time_step) {
  source.find(bodies, contacts_);
  prepare(bodies);
  for (int i = 0; i < settings_.substeps; ++i) substep(bodies, time_step / settings_.substeps);
}

void Solver::prepare(std::vector<Body>& bodies) {
  constraints_.clear();
  for (const Contact& contact : contacts_) {
    Constraint constraint;
    constraint.a = &bodies[contact.a];
    constraint.b = &bodies[contact.b];
    if (constraint.a->inverse_mass + constraint.b->inverse_mass == 0) continue;
    constraint.push = contact.push;
    constraint.own_a = constraint.a->to_own(contact.on_a);
    constraint.own_b = constraint.b->to_own(contact.on_b);
    constraint.offset = contact.separation - contact.push.dot(contact.on_b - contact.on_a);
    constraints_.push_back(constraint);
  }
}

void Solver::substep(std::vector<Body>& bodies, double time_step) {
  for (Constraint& constraint : constraints_) constraint.apart_before = constraint.apart();
  predict(bodies, time_step);
  for (Constraint& constraint : constraints_) {
    constraint.opening = constraint.opening_speed();
    constraint.pressure = 0;
  }
  for (Constraint& constraint : constraints_) solve_separation(constraint, time_step);
  for (const Constraint& constraint : constraints_) solve_friction(constraint);
  update_velocities(bodies, time_step);
  for (const Constraint& constraint : constraints_)
    if (constraint.pressure > 0) calm(constraint);
}

void Solver::predict(std::vector<Body>& bodies, double time_step) {
  places_.clear();
  for (Body& body : bodies) {
    places_.push_back({body.position, body.turn});
    if (body.inverse_mass > 0) {
      body.velocity += time_step * settings_.gravity;
      tumble(body, time_step);
    }
    body.position += time_step * body.velocity;
    body.rotate(time_step * body.spin);
  }
}

void Solver::solve_separation(Constraint& constraint, double time_step) const {
  const Eigen::Vector3d& push = constraint.push;
  const double separation_before = push.dot(constraint.apart_before) + constraint.offset;
  const double wanted = std::min(settings_.gap, separation_before + settings_.recovery_speed * time_step);
  const double missing = wanted - push.dot(constraint.apart()) - constraint.offset;
  if (missing <= 0) return;
  constraint.pressure = missing / constraint.yielding(push);
  constraint.shift(constraint.pressure * push);
}

void Solver::solve_friction(const Constraint& constraint) const {
  const Eigen::Vector3d moved = constraint.apart() - constraint.apart_before;
  const Eigen::Vector3d slid = moved - constraint.push.dot(moved) * constraint.push;
  const double way = slid.norm();
  if (constraint.pressure == 0 || way < 1e-15) return;
  const double drag = std::min(way / constraint.yielding(slid / way), settings_.friction * constraint.pressure);
  constraint.shift(-drag / way * slid);
}

void Solver::update_velocities(std::vector<Body>& bodies, double time_step) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (body.inverse_mass == 0) continue;
    body.velocity = (body.position - places_[i].position) / time_step;
    body.spin = spin_between(places_[i].turn, body.turn, time_step);
  }
}

}  // namespace graze::rigid
