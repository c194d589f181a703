#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <LinearMath/btGeometryUtil.h>

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bench/peers/rigid_bodies/rigid_finders.hpp"

namespace graze::bench {
namespace {

btVector3 vector_of(const double* numbers) {
  return {static_cast<btScalar>(numbers[0]), static_cast<btScalar>(numbers[1]),
          static_cast<btScalar>(numbers[2])};
}

void copy(const btVector3& vector, double (&numbers)[3]) {
  for (int i = 0; i < 3; ++i) numbers[i] = vector[i];
}

/// A shape of Bullet's, and what it is made of. Each is larger than the body by half the contact distance, in
/// Bullet's own way, so that Bullet finds contacts of bodies that do not touch yet.
struct BulletShape {
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  std::unique_ptr<btTriangleMesh> triangles;
  std::unique_ptr<btCollisionShape> whole;
};

BulletShape box_of(const RigidShape& shape, double grown) {
  const auto more = static_cast<btScalar>(grown);
  BulletShape box;
  box.whole = std::make_unique<btBoxShape>(vector_of(shape.half) + btVector3(more, more, more));
  return box;
}

/// Moves the planes of a hull's faces outward. The planes are found 100 times as large: Bullet takes those of
/// smaller hulls for rounding errors.
std::unique_ptr<btConvexHullShape> grown_hull(const std::vector<double>& points, double grown) {
  constexpr btScalar scale = 100;
  btAlignedObjectArray<btVector3> corners;
  for (std::size_t i = 0; i < points.size(); i += 3) corners.push_back(scale * vector_of(points.data() + i));
  btAlignedObjectArray<btVector3> planes;
  btGeometryUtil::getPlaneEquationsFromVertices(corners, planes);
  for (int i = 0; i < planes.size(); ++i) planes[i][3] -= scale * static_cast<btScalar>(grown);
  corners.clear();
  btGeometryUtil::getVerticesFromPlaneEquations(planes, corners);
  auto hull = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < corners.size(); ++i) hull->addPoint(corners[i] / scale, false);
  hull->recalcLocalAabb();
  hull->setMargin(0);
  hull->initializePolyhedralFeatures();  // so that Bullet clips faces: otherwise it finds one point a step
  return hull;
}

BulletShape hulls_of(const RigidShape& shape, double grown) {
  BulletShape hulls;
  for (const std::vector<double>& points : shape.parts) hulls.parts.push_back(grown_hull(points, grown));
  if (hulls.parts.size() == 1) {
    hulls.whole = std::move(hulls.parts.front());
    return hulls;
  }
  auto compound = std::make_unique<btCompoundShape>();
  for (const auto& part : hulls.parts) compound->addChildShape(btTransform::getIdentity(), part.get());
  hulls.whole = std::move(compound);
  return hulls;
}

BulletShape mesh_of(const RigidShape& shape, double grown) {
  BulletShape mesh;
  mesh.triangles = std::make_unique<btTriangleMesh>();
  const auto corner = [&](std::uint32_t index) {
    return vector_of(shape.points.data() + std::size_t{3} * index);
  };
  for (const Triangle& triangle : shape.triangles)
    mesh.triangles->addTriangle(corner(triangle.corners[0]), corner(triangle.corners[1]),
                                corner(triangle.corners[2]));
  auto whole = std::make_unique<btGImpactMeshShape>(mesh.triangles.get());
  whole->setMargin(static_cast<btScalar>(grown));
  whole->updateBound();
  mesh.whole = std::move(whole);
  return mesh;
}

/// A way to make shapes.
struct BulletKind {
  BulletShape (*make)(const RigidShape& shape, double grown) = nullptr;
  bool has_grown_points = true;  ///< whether contact points of b lie on the grown shape
};

/// Bullet's pipeline of collisions, without its solver. Bullet keeps up to four points of a pair from step to
/// step.
class BulletRigidBodies final : public RigidContactFinder {
 public:
  BulletRigidBodies(std::span<const RigidBodyView> bodies, double distance, const BulletKind& kind)
      : distance_(distance),
        kind_(kind),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &configuration_) {
    gContactBreakingThreshold = static_cast<btScalar>(distance);
    dispatcher_.setDispatcherFlags(0);  // the threshold does not depend on the size of a body
    // With its other search, by GJK, a point within the face takes the place of a corner.
    world_.getDispatchInfo().m_enableSatConvex = true;
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
    for (const RigidBodyView& body : bodies) add(body);
  }
  ~BulletRigidBodies() override {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  void find(std::span<const double> poses, std::vector<RigidContact>& contacts) override {
    for (std::size_t i = 0; i < objects_.size(); ++i)
      objects_[i]->setWorldTransform(transform_of(poses.data() + 12 * i));
    world_.performDiscreteCollisionDetection();
    contacts.clear();
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
      add(*dispatcher_.getManifoldByIndexInternal(i), contacts);
  }

 private:
  static btTransform transform_of(const double* pose) {
    btTransform transform;
    const btVector3 x = vector_of(pose);
    const btVector3 y = vector_of(pose + 3);
    const btVector3 z = vector_of(pose + 6);
    transform.getBasis().setValue(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z());
    transform.setOrigin(vector_of(pose + 9));
    return transform;
  }
  void add(const RigidBodyView& body) {
    BulletShape& shape = shapes_[body.shape];
    if (shape.whole == nullptr) shape = kind_.make(*body.shape, distance_ / 2);
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(shape.whole.get());
    object->setUserIndex(static_cast<int>(objects_.size()));
    if (body.is_fixed) object->setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
    const int group = body.is_fixed ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter;
    const int mask = btBroadphaseProxy::AllFilter ^ (body.is_fixed ? btBroadphaseProxy::StaticFilter : 0);
    world_.addCollisionObject(object.get(), group, mask);
    objects_.push_back(std::move(object));
  }
  void add(btPersistentManifold& manifold, std::vector<RigidContact>& contacts) {
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      btManifoldPoint& point = manifold.getContactPoint(i);
      // Bullet keeps this pointer with the point, and does not use it.
      if (point.m_userPersistentData == nullptr)
        point.m_userPersistentData = reinterpret_cast<void*>(++keys_);
      RigidContact& contact = contacts.emplace_back();
      contact.a = static_cast<std::uint32_t>(manifold.getBody0()->getUserIndex());
      contact.b = static_cast<std::uint32_t>(manifold.getBody1()->getUserIndex());
      contact.key = reinterpret_cast<std::uintptr_t>(point.m_userPersistentData);
      contact.separation = point.getDistance() + distance_;
      const btVector3 push = -point.m_normalWorldOnB;
      const double inset = kind_.has_grown_points ? distance_ / 2 : 0;
      const btVector3 on_b = point.getPositionWorldOnB() + static_cast<btScalar>(inset) * push;
      copy(push, contact.push);
      copy(on_b, contact.on_b);
      copy(on_b - static_cast<btScalar>(contact.separation) * push, contact.on_a);
    }
  }

  double distance_;
  BulletKind kind_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_;
  std::map<const RigidShape*, BulletShape> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::uintptr_t keys_ = 0;  ///< given to points so far
};

}  // namespace

std::unique_ptr<RigidContactFinder> make_bullet_boxes(std::span<const RigidBodyView> bodies,
                                                      double distance) {
  return std::make_unique<BulletRigidBodies>(bodies, distance, BulletKind{box_of});
}

std::unique_ptr<RigidContactFinder> make_bullet_hulls(std::span<const RigidBodyView> bodies,
                                                      double distance) {
  return std::make_unique<BulletRigidBodies>(bodies, distance, BulletKind{hulls_of});
}

std::unique_ptr<RigidContactFinder> make_bullet_meshes(std::span<const RigidBodyView> bodies,
                                                       double distance) {
  return std::make_unique<BulletRigidBodies>(bodies, distance, BulletKind{mesh_of, false});
}

}  // namespace graze::bench
