#include "examples/support/world.hpp"

#include <utility>

#include "examples/support/xpbd.hpp"

namespace examples {
namespace {

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
  object.self = added.meets_itself;
  object.self_rings = 0;  // features of one ring may fold onto each other, too
  object.user_data = bodies_.size() - 1;
  const graze::ObjectId id = scene_.add(added.mesh, object);
  scene_.bind_positions(id, added.positions);
  return added;
}

graze::ReportHandle World::step(double time_step) {
  graze::ReportHandle report = scene_.step();
  collect_constraints(*report, bodies_, constraints_);
  move(constraints_, time_step);
  return report;
}

void World::move(std::vector<ContactConstraint>& constraints, double time_step) {
  for (int i = 0; i < settings_.substeps; ++i) {
    if (i > 0)
      for (ContactConstraint& constraint : constraints) update(constraint);
    substep(constraints, time_step / settings_.substeps);
  }
}

void World::substep(const std::vector<ContactConstraint>& constraints, double time_step) {
  const Eigen::Vector3d gravity(0, 0, -settings_.gravity);
  for (Body& body : bodies_) predict(body, gravity, settings_.damping, time_step);
  for (int i = 0; i < settings_.iterations; ++i) {
    for (Body& body : bodies_) solve_springs(body, time_step);
    for (const ContactConstraint& constraint : constraints) solve(constraint, settings_.contacts, time_step);
  }
  for (Body& body : bodies_) update_velocities(body, time_step);
}

}  // namespace examples
