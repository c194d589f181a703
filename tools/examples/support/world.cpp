#include "examples/support/world.hpp"

#include <utility>

namespace examples {
namespace {

/// Moves vertices by their velocities, as if there were no springs and no contacts. Gravity pulls on what
/// has a finite mass.
void predict(Body& body, const Eigen::Vector3d& gravity, double kept, double time_step) {
  body.previous = body.positions;
  for (std::size_t i = 0; i < body.positions.size(); ++i) {
    if (body.inverse_masses[i] > 0) body.velocities[i] = kept * (body.velocities[i] + time_step * gravity);
    body.positions[i] += time_step * body.velocities[i];
  }
  for (Spring& spring : body.springs) spring.multiplier = 0;
}

void solve_springs(Body& body, double time_step) {
  for (Spring& spring : body.springs) {
    Eigen::Vector3d& a = body.positions[spring.a];
    Eigen::Vector3d& b = body.positions[spring.b];
    const Eigen::Vector3d apart = b - a;
    const double length = apart.norm();
    if (length == 0) continue;
    const double inverse_a = body.inverse_masses[spring.a];
    const double inverse_b = body.inverse_masses[spring.b];
    const double compliance = spring.compliance / (time_step * time_step);
    const double change =
        (spring.rest_length - length - compliance * spring.multiplier) / (inverse_a + inverse_b + compliance);
    spring.multiplier += change;
    a -= inverse_a * change / length * apart;
    b += inverse_b * change / length * apart;
  }
}

void update_velocities(Body& body, double time_step) {
  for (std::size_t i = 0; i < body.positions.size(); ++i)
    body.velocities[i] = (body.positions[i] - body.previous[i]) / time_step;
}

graze::SceneSettings scene_settings(double contact_distance) {
  graze::SceneSettings settings;
  settings.contact_distance = contact_distance;
  settings.detail = graze::ContactDetail::nearest;
  settings.threads = 1;
  return settings;
}

}  // namespace

World::World(const WorldSettings& settings)
    : settings_(settings), scene_(scene_settings(settings.contact_distance)) {}

Body& World::add(Body body) {
  Body& added = bodies_.emplace_back(std::move(body));
  graze::ObjectSettings object;
  object.solid = added.is_solid;
  object.user_data = bodies_.size() - 1;
  const graze::ObjectId id = scene_.add(added.mesh, object);
  scene_.bind_positions(id, added.positions);
  return added;
}

graze::ReportHandle World::step(double time_step) {
  const graze::ReportHandle report = scene_.step();
  collect_constraints(*report, bodies_, constraints_);
  for (int i = 0; i < settings_.substeps; ++i) {
    if (i > 0)
      for (ContactConstraint& constraint : constraints_) update(constraint);
    substep(time_step / settings_.substeps);
  }
  return report;
}

void World::substep(double time_step) {
  const Eigen::Vector3d gravity(0, 0, -settings_.gravity);
  const double kept = 1 - settings_.damping * time_step;
  for (Body& body : bodies_) predict(body, gravity, kept, time_step);
  for (int i = 0; i < settings_.iterations; ++i) {
    for (Body& body : bodies_) solve_springs(body, time_step);
    for (const ContactConstraint& constraint : constraints_) solve(constraint, settings_.contacts, time_step);
  }
  for (Body& body : bodies_) update_velocities(body, time_step);
}

}  // namespace examples
