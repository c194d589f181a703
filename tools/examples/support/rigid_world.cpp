#include "examples/support/rigid_world.hpp"

#include <algorithm>
#include <memory>

namespace examples {
namespace {

graze::SceneSettings scene_settings(const RigidWorldSettings& settings) {
  graze::SceneSettings scene;
  scene.contact_distance = settings.contact_distance;
  scene.carrying = settings.carrying;
  scene.ways_out = settings.ways_out;
  scene.threads = 1;
  return scene;
}

}  // namespace

RigidWorld::RigidWorld(const RigidWorldSettings& settings)
    : source_(scene_settings(settings)), solver_(settings.solver) {}

std::uint32_t RigidWorld::add(const Shape& shape, const Eigen::Isometry3d& pose, double density,
                              const graze::ObjectSettings& object) {
  const auto mesh =
      std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
  graze::rigid::Body body;
  if (density > 0) body.set_mass(graze::rigid::mass_of(*mesh, density));
  body.set_pose(pose);
  source_.add(mesh, body, object);
  shapes_.emplace_back(*mesh);
  bodies_.push_back(body);
  return static_cast<std::uint32_t>(bodies_.size() - 1);
}

void RigidWorld::step(double time_step) {
  solver_.step(bodies_, source_, time_step);
}

double RigidWorld::deepest_overlap() const {
  double deepest = 0;
  for (std::size_t a = 0; a < bodies_.size(); ++a)
    for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
      if (bodies_[a].inverse_mass + bodies_[b].inverse_mass == 0) continue;
      deepest = std::max(deepest, overlap(shapes_[a], bodies_[a].pose(), shapes_[b], bodies_[b].pose()));
    }
  return deepest;
}

double RigidWorld::largest_speed() const {
  double largest = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    largest = std::max(largest, bodies_[i].velocity.norm() + bodies_[i].spin.norm() * shapes_[i].radius());
  return largest;
}

std::size_t RigidWorld::silent_crossings() const {
  const auto pairs = report().pairs();
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [&](const graze::PairReport& pair) {
        if (pair.inside != graze::Inside::crossing || !pair.way_out.direction.isZero()) return false;
        const auto contacts = report().contacts(pair);
        return std::none_of(contacts.begin(), contacts.end(),
                            [](const graze::Contact& contact) { return contact.separation() < 0; });
      }));
}

}  // namespace examples
