#include "rigid/solver.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace graze::rigid {
namespace {

// A contact that is too near is a spring with a damper, as stiff as a substep can take: a fifth of the
// frequency of substeps, and critically damped. These three numbers follow from that.
constexpr double recovery = 0.386;  ///< share of what is missing that a substep pushes out
constexpr double stiffness = 0.804;
constexpr double softness = 0.196;

/// Moves a body by its velocities. The angular momentum stays, so a body whose inertia differs from axis to
/// axis tumbles.
void move(Body& body, double time_step) {
  body.position += time_step * body.velocity;
  if (body.inverse_mass == 0) {
    body.rotate(time_step * body.spin);
    return;
  }
  const Eigen::Matrix3d inertia = body.inverse_inertia.inverse();
  const Eigen::Vector3d momentum = body.turn * (inertia * (body.turn.conjugate() * body.spin));
  body.rotate(time_step * body.spin);
  body.spin = body.turn * (body.inverse_inertia * (body.turn.conjugate() * momentum));
}

}  // namespace

double Solver::Constraint::separation() const {
  return push.dot(b->to_world(own_b) - a->to_world(own_a)) + offset;
}

Eigen::Vector3d Solver::Constraint::relative_velocity() const {
  return b->velocity_at(b->turn * own_b) - a->velocity_at(a->turn * own_a);
}

double Solver::Constraint::yielding(const Eigen::Vector3d& along) const {
  return a->yielding(a->turn * own_a, along) + b->yielding(b->turn * own_b, along);
}

void Solver::Constraint::apply(const Eigen::Vector3d& impulse_on_b) const {
  a->push(-impulse_on_b, a->turn * own_a);
  b->push(impulse_on_b, b->turn * own_b);
}

void Solver::step(std::vector<Body>& bodies, ContactSource& source, double time_step) {
  std::swap(contacts_, last_contacts_);
  source.find(bodies, contacts_);
  prepare(bodies);
  for (int i = 0; i < settings_.substeps; ++i) substep(bodies, time_step / settings_.substeps);
}

void Solver::prepare(std::vector<Body>& bodies) {
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>, Impulse> last;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const Contact& contact = last_contacts_[i];
    if (contact.key != 0) last[{contact.a, contact.b, contact.key}] = constraints_[i].impulse;
  }
  constraints_.clear();
  for (const Contact& contact : contacts_) {
    Constraint& constraint = constraints_.emplace_back();
    constraint.a = &bodies[contact.a];
    constraint.b = &bodies[contact.b];
    constraint.push = contact.push;
    constraint.own_a = constraint.a->to_own(contact.on_a);
    constraint.own_b = constraint.b->to_own(contact.on_b);
    constraint.offset = contact.separation - contact.push.dot(contact.on_b - contact.on_a);
    const auto found = last.find({contact.a, contact.b, contact.key});
    if (found == last.end()) continue;
    constraint.impulse = found->second;
    constraint.impulse.drag -= contact.push.dot(constraint.impulse.drag) * contact.push;
  }
}

void Solver::substep(std::vector<Body>& bodies, double time_step) {
  for (Body& body : bodies)
    if (body.inverse_mass > 0) body.velocity += time_step * settings_.gravity;
  for (const Constraint& constraint : constraints_)
    constraint.apply(constraint.impulse.pressure * constraint.push + constraint.impulse.drag);
  solve(time_step, true);
  for (Body& body : bodies) move(body, time_step);
  // What was pushed out does not fly on.
  solve(time_step, false);
}

void Solver::solve(double time_step, bool pushes_out) {
  for (Constraint& constraint : constraints_) solve_pressure(constraint, time_step, pushes_out);
  for (Constraint& constraint : constraints_) solve_drag(constraint);
}

void Solver::solve_pressure(Constraint& constraint, double time_step, bool pushes_out) const {
  const double yielding = constraint.yielding(constraint.push);
  if (yielding == 0) return;
  const double room = constraint.separation() - settings_.gap;
  const double opening = constraint.push.dot(constraint.relative_velocity());
  double& pressure = constraint.impulse.pressure;
  double change = 0;
  if (room > 0)  // it may come as near as the gap in this substep
    change = -(opening + room / time_step) / yielding;
  else if (pushes_out)
    change =
        stiffness * (std::min(-recovery * room / time_step, settings_.recovery_speed) - opening) / yielding -
        softness * pressure;
  else
    change = -opening / yielding;
  change = std::max(change, -pressure);
  pressure += change;
  constraint.apply(change * constraint.push);
}

void Solver::solve_drag(Constraint& constraint) const {
  const Eigen::Vector3d velocity = constraint.relative_velocity();
  const Eigen::Vector3d sliding = velocity - constraint.push.dot(velocity) * constraint.push;
  const double speed = sliding.norm();
  if (speed < 1e-12) return;
  const double yielding = constraint.yielding(sliding / speed);
  if (yielding == 0) return;
  Eigen::Vector3d drag = constraint.impulse.drag - sliding / yielding;
  const double most = settings_.friction * constraint.impulse.pressure;
  if (drag.norm() > most) drag *= most / drag.norm();
  constraint.apply(drag - std::exchange(constraint.impulse.drag, drag));
}

}  // namespace graze::rigid
