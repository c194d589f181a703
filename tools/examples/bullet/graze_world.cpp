#include "examples/bullet/graze_world.hpp"

namespace examples::bullet {
namespace {

constexpr double speed = 4;      // m/s, at which two bodies may approach each other
constexpr int most_repeats = 5;  // of pushes, as in Bullet's own detection
constexpr std::uint32_t soft_kind = 0;
constexpr std::uint32_t rigid_kind = 1;

/// Leaves pairs with a soft body to graze.
void find_rigid_pair(btBroadphasePair& pair, btCollisionDispatcher& dispatcher,
                     const btDispatcherInfo& info) {
  for (const btBroadphaseProxy* proxy : {pair.m_pProxy0, pair.m_pProxy1})
    if (btSoftBody::upcast(static_cast<const btCollisionObject*>(proxy->m_clientObject)) != nullptr) return;
  btCollisionDispatcher::defaultNearCallback(pair, dispatcher, info);
}

bool is_vertex(const graze::Feature& feature) {
  return feature.kind == graze::FeatureKind::vertex;
}

}  // namespace

// Soft bodies come first, so a soft body is a in each pair with a rigid one.
void GrazeWorld::attach(const Bodies& bodies, double time_step) {
  bodies_ = &bodies;
  reach_ = speed * time_step;
  static_cast<btCollisionDispatcher*>(getDispatcher())->setNearCallback(find_rigid_pair);
  scene_ = std::make_unique<graze::Scene>(graze::SceneSettings{
      .contact_distance = contact_distance(false), .detail = graze::ContactDetail::nearest, .threads = 1});
  scene_->set_rule(soft_kind, rigid_kind, {.contact_distance = contact_distance(true)});
  for (const SoftPart& part : bodies.soft()) {
    const graze::ObjectId id = scene_->add(
        part.mesh, {.name = "ball", .kind = soft_kind, .solid = true, .user_data = faces_.size()});
    scene_->bind_positions(id, positions_of(*part.body));
    faces_.emplace_back(*part.mesh);
    part.body->m_ndbvt.clear();  // nobody asks Bullet's own tree
  }
  for (std::size_t i = 0; i < bodies.rigid().size(); ++i) {
    const RigidPart& part = bodies.rigid()[i];
    const auto motion = part.body->isStaticObject() ? graze::Motion::fixed : graze::Motion::rigid;
    paddle_ = scene_->add(
        part.mesh,
        {.name = part.name, .motion = motion, .group = 1, .kind = rigid_kind, .solid = true, .user_data = i});
    scene_->set_pose(paddle_, pose_of(*part.body));
  }
}

void GrazeWorld::find_rigid_contacts(btScalar time_step) {
  performDiscreteCollisionDetection();
  scene_->set_pose(paddle_, pose_of(*bodies_->rigid().back().body));
  report_ = scene_->step();
  for (const graze::PairReport& pair : report_->pairs())
    if (pair.b.index >= bodies_->soft().size())
      for (const graze::Contact& contact : report_->contacts(pair)) add_rigid(pair, contact, time_step);
}

void GrazeWorld::find_soft_contacts(btScalar time_step) {
  for (const graze::PairReport& pair : report_->pairs())
    if (pair.b.index < bodies_->soft().size())
      for (const graze::Contact& contact : report_->contacts(pair)) add_soft(pair, contact, time_step);
}

/// An edge that pierces a face says nothing of its depth. The vertices behind the face have contacts of their
/// own.
void GrazeWorld::add_rigid(const graze::PairReport& pair, const graze::Contact& contact, btScalar time_step) {
  if (contact.kind == graze::ContactKind::EF && contact.distance == 0) return;
  add_rigid_contact(point_of(pair.user_data_a, contact.feature_a, contact.point_a), contact.point_b,
                    *bodies_->rigid()[pair.user_data_b].body, {-contact.push(), contact.separation()},
                    time_step);
}

/// Bullet's contacts of soft bodies are of a node and a face. It has none for two edges.
void GrazeWorld::add_soft(const graze::PairReport& pair, const graze::Contact& contact, btScalar time_step) {
  const bool has_vertex_a = is_vertex(contact.feature_a);
  if (!has_vertex_a && !is_vertex(contact.feature_b)) return;
  const SoftPoint a = point_of(pair.user_data_a, contact.feature_a, contact.point_a);
  const SoftPoint b = point_of(pair.user_data_b, contact.feature_b, contact.point_b);
  if (has_vertex_a)
    add_soft_contact(a, b, {-contact.push(), contact.separation()}, time_step);
  else
    add_soft_contact(b, a, {contact.push(), contact.separation()}, time_step);
}

SoftPoint GrazeWorld::point_of(std::uint64_t soft, const graze::Feature& feature,
                               const Eigen::Vector3d& point) const {
  return soft_point(bodies_->soft()[soft], faces_[soft], feature, point);
}

bool GrazeWorld::is_crossing(btScalar time_step) const {
  for (const SoftPart& part : bodies_->soft())
    for (int i = 0; i < part.body->m_faceNodeContacts.size(); ++i)
      if (gap_after(part.body->m_faceNodeContacts[i], time_step) < 0) return true;
  return false;
}

void GrazeWorld::stop_crossings(btScalar time_step) {
  for (int i = 0; i < most_repeats && is_crossing(time_step); ++i)
    for (const SoftPart& part : bodies_->soft()) part.body->applyRepulsionForce(time_step, false);
}

}  // namespace examples::bullet
