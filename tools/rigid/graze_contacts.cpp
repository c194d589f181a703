#include "rigid/graze_contacts.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace graze::rigid {
namespace {

SceneSettings with_nearest(SceneSettings settings) {
  settings.detail = ContactDetail::nearest;
  return settings;
}

/// Packs the two features of a contact into a number that is not 0.
std::uint64_t key_of(const graze::Contact& contact) {
  const auto packed = [](const Feature& feature) {
    return (static_cast<std::uint64_t>(feature.kind) + 1) << 30 | feature.index;
  };
  return packed(contact.feature_a) << 32 | packed(contact.feature_b);
}

}  // namespace

GrazeContacts::GrazeContacts(SceneSettings settings) : scene_(with_nearest(std::move(settings))) {}

ObjectId GrazeContacts::add(std::shared_ptr<const Mesh> mesh, const Body& body, ObjectSettings object) {
  object.motion = body.inverse_mass > 0 ? Motion::rigid : Motion::fixed;
  object.solid = true;
  meshes_.push_back(mesh);
  object.user_data = ids_.size();
  return ids_.emplace_back(scene_.add(std::move(mesh), object));
}

void GrazeContacts::find(std::span<const Body> bodies, std::vector<Contact>& contacts) {
  rotations_.clear();
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const Eigen::Isometry3d pose = bodies[i].pose();
    rotations_.emplace_back(pose.linear());
    scene_.set_pose(ids_[i], pose);
  }
  report_ = scene_.step();
  contacts.clear();
  for (const PairReport& pair : report_->pairs()) add_contacts(pair, contacts);
}

bool GrazeContacts::bears(std::uint32_t body, const Feature& feature, const Eigen::Vector3d& way) const {
  if (feature.kind == FeatureKind::face) return true;
  const Mesh& mesh = *meshes_[body];
  return in_normal_cone(mesh, mesh.rest(), feature, rotations_[body].transpose() * way);
}

void GrazeContacts::add_contacts(const PairReport& pair, std::vector<Contact>& contacts) const {
  const auto a = static_cast<std::uint32_t>(pair.user_data_a);
  const auto b = static_cast<std::uint32_t>(pair.user_data_b);
  const std::size_t first = contacts.size();
  double deepest = 0;
  for (const graze::Contact& contact : report_->contacts(pair)) {
    if (contact.kind == ContactKind::EF && contact.distance == 0) continue;
    if (!bears(a, contact.feature_a, contact.push()) || !bears(b, contact.feature_b, -contact.push()))
      continue;
    contacts.push_back(
        {a, b, contact.point_a, contact.point_b, contact.push(), contact.separation(), key_of(contact)});
    deepest = std::max(deepest, -contact.separation());
  }
  const WayOut& way = pair.way_out;
  if (way.direction.isZero() || deepest >= way.thickness / 4) return;
  contacts.resize(first);
  contacts.push_back({a, b, way.point, way.point, way.direction, 0});
}

}  // namespace graze::rigid
