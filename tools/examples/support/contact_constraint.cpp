#include "examples/support/contact_constraint.hpp"

#include <algorithm>

#include "examples/support/carried_point.hpp"

namespace examples {
namespace {

/// Returns whether a contact is inside a solid. Of two solids separation() says so. An open surface has no
/// inside: what lies behind it is no deeper than what lies before it, so only the side of the solid counts.
bool is_inside(const graze::Contact& contact, const Body& a, const Body& b) {
  if (a.is_solid && b.is_solid) return contact.separation() < 0;
  return (a.is_solid && contact.side_a == graze::Side::back) ||
         (b.is_solid && contact.side_b == graze::Side::back);
}

}  // namespace

void collect_constraints(const graze::FrameReport& report, std::deque<Body>& bodies,
                         std::vector<ContactConstraint>& constraints) {
  constraints.clear();
  for (const graze::PairReport& pair : report.pairs()) {
    Body& a = bodies[pair.user_data_a];
    Body& b = bodies[pair.user_data_b];
    for (const graze::Contact& contact : report.contacts(pair)) {
      // An edge that pierces a face does not say how deep it is. The vertices behind the face do.
      if (contact.kind == graze::ContactKind::EF && contact.distance == 0) continue;
      const double sign = is_inside(contact, a, b) ? -1 : 1;
      constraints.push_back({&a, &b, contact.feature_a, contact.feature_b,
                             graze::weights(*a.mesh, a.positions, contact.feature_a, contact.point_a),
                             graze::weights(*b.mesh, b.positions, contact.feature_b, contact.point_b),
                             sign * contact.normal, sign * contact.distance});
    }
  }
}

void update(ContactConstraint& constraint) {
  if (constraint.is_plane) return;
  const Body& a = *constraint.a;
  const Body& b = *constraint.b;
  const graze::ContactGeometry now =
      graze::evaluate(*a.mesh, a.positions, constraint.feature_a, *b.mesh, b.positions, constraint.feature_b);
  if (!now.is_interior) return;
  // Features that have passed through each other are pushed back to where they came from.
  const double sign = now.normal.dot(constraint.direction) < 0 ? -1 : 1;
  constraint.direction = sign * now.normal;
  constraint.separation = sign * now.distance;
  constraint.weights_a = graze::weights(*a.mesh, a.positions, constraint.feature_a, now.point_a);
  constraint.weights_b = graze::weights(*b.mesh, b.positions, constraint.feature_b, now.point_b);
}

void solve(const ContactConstraint& constraint, const ContactSettings& settings, double time_step) {
  Body* const a = constraint.a;
  Body* const b = constraint.b;
  const graze::SurfaceWeights& weights_a = constraint.weights_a;
  const graze::SurfaceWeights& weights_b = constraint.weights_b;
  const Eigen::Vector3d& direction = constraint.direction;
  const Eigen::Vector3d apart = carried(weights_b, b->positions) - carried(weights_a, a->positions);
  const double wanted = std::min(settings.gap, constraint.separation + settings.recovery_speed * time_step);
  const double depth = wanted - direction.dot(apart);
  const double yielding = inverse_mass(weights_a, *a) + inverse_mass(weights_b, *b);
  if (depth <= 0 || yielding == 0) return;

  const Eigen::Vector3d apart_before = carried(weights_b, b->previous) - carried(weights_a, a->previous);
  const Eigen::Vector3d moved = apart - apart_before;
  const Eigen::Vector3d slid = moved - direction.dot(moved) * direction;
  const double held = std::min(1.0, settings.friction * depth / std::max(slid.norm(), 1e-30));
  const Eigen::Vector3d impulse = (depth * direction - held * slid) / yielding;
  apply(weights_b, impulse, *b);
  apply(weights_a, -impulse, *a);
}

}  // namespace examples
