#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletSoftBody/btDefaultSoftBodySolver.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "bench/soft_bodies/soft_contacts.hpp"

namespace graze::bench {
namespace {

btVector3 vector_of(std::span<const double> numbers, std::size_t index) {
  const double* const point = numbers.data() + 3 * index;
  return {static_cast<btScalar>(point[0]), static_cast<btScalar>(point[1]), static_cast<btScalar>(point[2])};
}

void copy(const btVector3& vector, double (&numbers)[3]) {
  for (int i = 0; i < 3; ++i) numbers[i] = vector[i];
}

/// A ball or a box of Bullet's own shape, as large as the body is at the beginning.
class RigidPart {
 public:
  RigidPart(const SoftBodyView& body, std::uint32_t index, btCollisionWorld& world)
      : body_(body), first_(vector_of(body.positions, 0)) {
    btVector3 low = first_;
    btVector3 high = first_;
    for (std::size_t i = 0; i < body.positions.size() / 3; ++i) {
      low.setMin(vector_of(body.positions, i));
      high.setMax(vector_of(body.positions, i));
    }
    centre_ = (low + high) / 2;
    const btVector3 half = (high - low) / 2;
    if (body.kind == SoftBodyKind::ball)
      shape_ = std::make_unique<btSphereShape>(half.z());  // the poles are vertices
    else
      shape_ = std::make_unique<btBoxShape>(half);
    object_.setCollisionShape(shape_.get());
    object_.setUserIndex(static_cast<int>(index));
    place();
    world.addCollisionObject(&object_, btBroadphaseProxy::StaticFilter,
                             btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
  }

  void place() {
    object_.getWorldTransform().setIdentity();
    object_.getWorldTransform().setOrigin(centre_ + vector_of(body_.positions, 0) - first_);
  }

 private:
  const SoftBodyView& body_;
  btVector3 first_;
  btVector3 centre_;
  std::unique_ptr<btConvexShape> shape_;
  btCollisionObject object_;
};

/// A soft body of the vertices that faces use. Bullet moves none of them for good: each frame places them.
class SoftPart {
 public:
  SoftPart(const SoftBodyView& body, std::uint32_t index, const SoftContactSettings& settings,
           btSoftBodyWorldInfo& info)
      : body_(body), settings_(settings) {
    std::vector<int> node_of(body.positions.size() / 3, -1);
    std::vector<btVector3> points;
    std::vector<btScalar> masses;
    for (const Triangle& triangle : body.triangles)
      for (const std::uint32_t corner : triangle.corners) {
        if (node_of[corner] >= 0) continue;
        node_of[corner] = static_cast<int>(vertices_.size());
        vertices_.push_back(corner);
        points.push_back(vector_of(body.positions, corner));
        const double inverse_mass = body.inverse_masses[corner];
        masses.push_back(inverse_mass > 0 ? static_cast<btScalar>(1 / inverse_mass) : 0);
      }
    soft_ =
        std::make_unique<btSoftBody>(&info, static_cast<int>(points.size()), points.data(), masses.data());
    soft_->getCollisionShape()->setMargin(static_cast<btScalar>(settings.margin));
    soft_->setUserIndex(static_cast<int>(index));
    add_faces(node_of);
  }

  /// Joins a world. Without soft neighbours Bullet needs no tree of the faces.
  void join(btCollisionWorld& world, btSoftBodySolver& solver, bool has_soft_neighbours) {
    soft_->m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
    if (has_soft_neighbours) soft_->m_cfg.collisions |= btSoftBody::fCollision::VF_SS;
    soft_->setSoftBodySolver(&solver);
    world.addCollisionObject(soft_.get(), btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
  }

  /// Lets Bullet predict the vertices' motion of the last time step, up to where they are now. That updates
  /// its trees and forgets all contacts.
  void place() {
    const auto time_step = static_cast<btScalar>(settings_.time_step);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      btSoftBody::Node& node = soft_->m_nodes[static_cast<int>(i)];
      node.m_v = vector_of(body_.velocities, vertices_[i]);
      node.m_x = vector_of(body_.positions, vertices_[i]) - time_step * node.m_v;
    }
    soft_->predictMotion(time_step);
  }

  void collect(std::vector<SoftContact>& contacts) const {
    for (int i = 0; i < soft_->m_scontacts.size(); ++i) add(soft_->m_scontacts[i], contacts);
    for (int i = 0; i < soft_->m_rcontacts.size(); ++i) add(soft_->m_rcontacts[i], contacts);
  }

 private:
  /// Bullet makes its tree of vertices along links, and does not end without them. Its solver is not asked
  /// to hold them.
  void add_faces(const std::vector<int>& node_of) {
    std::set<std::pair<int, int>> links;
    for (const Triangle& triangle : body_.triangles) {
      int nodes[3];
      for (int i = 0; i < 3; ++i) nodes[i] = node_of[triangle.corners[i]];
      soft_->appendFace(nodes[0], nodes[1], nodes[2]);
      for (int i = 0; i < 3; ++i) links.insert(std::minmax(nodes[i], nodes[(i + 1) % 3]));
    }
    for (const auto& [a, b] : links) soft_->appendLink(a, b);
    for (int i = 0; i < soft_->m_faces.size(); ++i) soft_->m_faces[i].m_tag = this;
  }

  [[nodiscard]] SoftContact contact_at(const btSoftBody::Node* node, const btVector3& normal) const {
    SoftContact contact;
    contact.body = static_cast<std::uint32_t>(soft_->getUserIndex());
    contact.vertex = vertices_[static_cast<std::size_t>(node - &soft_->m_nodes[0])];
    copy(normal, contact.normal);
    return contact;
  }

  void add(const btSoftBody::SContact& found, std::vector<SoftContact>& contacts) const {
    if (!std::isfinite(found.m_normal.length2())) return;  // the vertex lies on the face
    SoftContact contact = contact_at(found.m_node, found.m_normal);
    const btSoftBody& other = *static_cast<const SoftPart*>(found.m_face->m_tag)->soft_;
    contact.other = static_cast<std::uint32_t>(other.getUserIndex());
    contact.face = static_cast<std::uint32_t>(found.m_face - &other.m_faces[0]);
    copy(found.m_weights, contact.weights);
    contacts.push_back(contact);
  }

  /// Bullet's offset is that of a plane at the margin from the rigid body.
  void add(const btSoftBody::RContact& found, std::vector<SoftContact>& contacts) const {
    const btVector3& normal = found.m_cti.m_normal;
    const btVector3& vertex = found.m_node->m_x;
    SoftContact contact = contact_at(found.m_node, normal);
    contact.is_other_rigid = true;
    contact.other = static_cast<std::uint32_t>(found.m_cti.m_colObj->getUserIndex());
    const btScalar distance =
        normal.dot(vertex) + found.m_cti.m_offset + static_cast<btScalar>(settings_.margin);
    copy(vertex - distance * normal, contact.point);
    contacts.push_back(contact);
  }

  const SoftBodyView& body_;
  const SoftContactSettings& settings_;
  std::vector<std::uint32_t> vertices_;  ///< of each node
  std::unique_ptr<btSoftBody> soft_;
};

/// Bullet's pipeline of collisions, without its solver: soft bodies against each other by vertex and face,
/// and against rigid ones by signed distance.
class BulletSoftBodies : public SoftContactFinder {
 public:
  BulletSoftBodies(std::span<const SoftBodyView> bodies, const SoftContactSettings& settings)
      : bodies_(bodies.begin(), bodies.end()),
        settings_(settings),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &configuration_) {
    info_.m_broadphase = &broadphase_;
    info_.m_dispatcher = &dispatcher_;
    info_.m_gravity.setZero();
    info_.m_sparsesdf.Initialize();
    info_.m_sparsesdf.setDefaultVoxelsz(static_cast<btScalar>(settings.voxel));
    info_.m_sparsesdf.Reset();  // takes the new size up
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
      if (bodies_[i].kind == SoftBodyKind::deformable)
        soft_.push_back(std::make_unique<SoftPart>(bodies_[i], i, settings_, info_));
      else
        rigid_.push_back(std::make_unique<RigidPart>(bodies_[i], i, world_));
    for (const auto& part : soft_) part->join(world_, solver_, soft_.size() > 1);
  }
  ~BulletSoftBodies() override {
    for (int i = world_.getNumCollisionObjects() - 1; i >= 0; --i)
      world_.removeCollisionObject(world_.getCollisionObjectArray()[i]);
  }

  void find(std::vector<SoftContact>& contacts) override {
    for (const auto& part : rigid_) part->place();
    for (const auto& part : soft_) part->place();
    world_.performDiscreteCollisionDetection();
    contacts.clear();
    for (const auto& part : soft_) part->collect(contacts);
  }

 private:
  std::vector<SoftBodyView> bodies_;
  SoftContactSettings settings_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSoftBodyWorldInfo info_;
  btDefaultSoftBodySolver solver_;
  btCollisionWorld world_;
  std::vector<std::unique_ptr<RigidPart>> rigid_;
  std::vector<std::unique_ptr<SoftPart>> soft_;
};

}  // namespace
}  // namespace graze::bench

extern "C" [[gnu::visibility("default")]] void graze_bench_soft_contacts(
    std::span<const graze::bench::SoftBodyView> bodies, const graze::bench::SoftContactSettings& settings,
    std::unique_ptr<graze::bench::SoftContactFinder>& finder) {
  finder = std::make_unique<graze::bench::BulletSoftBodies>(bodies, settings);
}
