#pragma once

#include <cstdint>
#include <graze/graze.hpp>
#include <vector>

#include "examples/bullet/bodies.hpp"

namespace examples::bullet {

/// Returns a view of Bullet's nodes as they lie, a fixed number of bytes apart. It is good as long as the
/// body gets no more nodes.
graze::PositionView positions_of(const btSoftBody& body);

/// Finds a face for each feature of a mesh: Bullet shares a push out to the three nodes of a face.
class FaceOfFeature {
 public:
  explicit FaceOfFeature(const graze::Mesh& mesh);

  /// Returns the index of a face that has the feature.
  [[nodiscard]] std::uint32_t operator()(const graze::Feature& feature) const;

 private:
  std::vector<std::uint32_t> of_vertex_;
  std::vector<std::uint32_t> of_edge_;
};

/// A point on the surface of a soft body, as Bullet has it.
struct SoftPoint {
  btSoftBody* body = nullptr;
  btSoftBody::Node* node = nullptr;  ///< null if the point is no node
  btSoftBody::Face* face = nullptr;
  btVector3 weights{0, 0, 0};  ///< of the nodes of the face

  [[nodiscard]] btVector3 velocity() const;
  /// Returns the distance at which Bullet keeps the body from others.
  [[nodiscard]] btScalar margin() const { return body->getCollisionShape()->getMargin(); }
};

/// Returns the point of a soft body at which a contact is.
SoftPoint soft_point(const SoftPart& part, const FaceOfFeature& faces, const graze::Feature& feature,
                     const Eigen::Vector3d& point);

/// A gap between two points, and the direction along which it is measured. It is negative where one body is
/// in the other.
struct Gap {
  Gap(const Eigen::Vector3d& along, double length)
      : normal(to_bullet(along)), distance(static_cast<btScalar>(length)) {}

  btVector3 normal;
  btScalar distance;
};

/// Gives a contact with a rigid body to Bullet, if the gap is below the margin at the end of the step. Its
/// normal leads out of the rigid body, at the point `place` of that body.
void add_rigid_contact(const SoftPoint& point, const Eigen::Vector3d& place, btRigidBody& rigid,
                       const Gap& gap, btScalar time_step);

/// Gives a contact of a node with a face of another soft body to Bullet, if the gap is below both margins at
/// the end of the step. Its normal leads from the face to the node.
void add_soft_contact(const SoftPoint& vertex, const SoftPoint& surface, const Gap& gap, btScalar time_step);

/// Returns the gap of a node and a face at the end of the step, along the normal of their contact.
btScalar gap_after(const btSoftBody::DeformableFaceNodeContact& contact, btScalar time_step);

}  // namespace examples::bullet
