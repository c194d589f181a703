#include "bench/rigid_bodies/rigid_body_sources.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <graze/graze.hpp>
#include <utility>
#include <vector>

#include "rigid/graze_contacts.hpp"

namespace graze::bench {
namespace {

std::unique_ptr<rigid::ContactSource> graze_contacts(const RigidBodyScene& scene, std::size_t carrying) {
  SceneSettings settings;
  settings.contact_distance = rigid_contact_distance;
  settings.threads = 1;
  settings.ways_out = true;
  settings.carrying = carrying;
  auto contacts = std::make_unique<rigid::GrazeContacts>(settings);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) contacts->add(scene.shapes[i]->mesh, scene.bodies[i]);
  return contacts;
}

/// Asks a finder of the module.
class FoundContacts final : public rigid::ContactSource {
 public:
  FoundContacts(const RigidBodyScene& scene, const RigidContactEntry& entry) : shapes_(scene.shapes) {
    std::vector<RigidBodyView> views;
    for (std::size_t i = 0; i < shapes_.size(); ++i)
      views.push_back({&shapes_[i]->plain, scene.bodies[i].inverse_mass == 0});
    finder_ = entry.make(views, rigid_contact_distance);
  }

  void find(std::span<const rigid::Body> bodies, std::vector<rigid::Contact>& contacts) override {
    poses_.resize(12 * bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Eigen::Map<Eigen::Matrix<double, 3, 4>> pose(poses_.data() + 12 * i);
      pose << bodies[i].turn.toRotationMatrix(), bodies[i].position;
    }
    finder_->find(poses_, found_);
    contacts.clear();
    for (const RigidContact& contact : found_)
      contacts.push_back({contact.a, contact.b, Eigen::Map<const Eigen::Vector3d>(contact.on_a),
                          Eigen::Map<const Eigen::Vector3d>(contact.on_b),
                          Eigen::Map<const Eigen::Vector3d>(contact.push), contact.separation, contact.key});
  }

 private:
  std::vector<RigidBodyShapePtr> shapes_;  ///< which the finder reads
  std::unique_ptr<RigidContactFinder> finder_;
  std::vector<double> poses_;
  std::vector<RigidContact> found_;
};

}  // namespace

std::vector<RigidBodySource> rigid_body_sources(const RigidBodyScene& scene,
                                                std::span<const RigidContactEntry> entries) {
  std::vector<RigidBodySource> sources;
  sources.push_back({"graze", graze_contacts(scene, 0)});
  sources.push_back({"graze, carrying 8", graze_contacts(scene, 8)});
  for (const RigidContactEntry& entry : entries)
    if (scene.is_convex() ? entry.takes_convex : entry.takes_non_convex)
      sources.push_back({std::string(entry.name), std::make_unique<FoundContacts>(scene, entry)});
  return sources;
}

}  // namespace graze::bench
