#include "examples/bullet/contacts.hpp"

#include <BulletSoftBody/btSoftBodyInternals.h>

#include <algorithm>
#include <map>

namespace examples::bullet {

graze::PositionView positions_of(const btSoftBody& body) {
  const btScalar* const first = body.m_nodes[0].m_x.m_floats;
  return {first, static_cast<std::size_t>(body.m_nodes.size()), sizeof(btSoftBody::Node)};
}

FaceOfFeature::FaceOfFeature(const graze::Mesh& mesh)
    : of_vertex_(mesh.vertex_count()), of_edge_(mesh.edge_count()) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> face_of_ends;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = mesh.face(face)[i];
      const std::uint32_t to = mesh.face(face)[(i + 1) % 3];
      of_vertex_[from] = face;
      face_of_ends[{std::min(from, to), std::max(from, to)}] = face;
    }
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) {
    const auto [a, b] = mesh.edge(edge);
    of_edge_[edge] = face_of_ends.at({std::min(a, b), std::max(a, b)});
  }
}

std::uint32_t FaceOfFeature::operator()(const graze::Feature& feature) const {
  if (feature.kind == graze::FeatureKind::vertex) return of_vertex_[feature.index];
  return feature.kind == graze::FeatureKind::edge ? of_edge_[feature.index] : feature.index;
}

SoftPoint soft_point(const SoftPart& part, const FaceOfFeature& faces, const graze::Feature& feature,
                     const Eigen::Vector3d& point) {
  SoftPoint found;
  found.body = part.body.get();
  if (feature.kind == graze::FeatureKind::vertex)
    found.node = &found.body->m_nodes[static_cast<int>(feature.index)];
  found.face = &found.body->m_faces[static_cast<int>(faces(feature))];
  const graze::SurfaceWeights shares = graze::weights(*part.mesh, positions_of(*found.body), feature, point);
  for (std::size_t i = 0; i < static_cast<std::size_t>(shares.count); ++i)
    for (int corner = 0; corner < 3; ++corner)
      if (found.face->m_n[corner] == &found.body->m_nodes[static_cast<int>(shares.vertex[i])])
        found.weights[corner] = static_cast<btScalar>(shares.weight[i]);
  return found;
}

namespace {

/// The velocity of a point of a face by its weights.
btVector3 velocity_on(const btSoftBody::Face& face, const btVector3& weights) {
  return BaryEval(face.m_n[0]->m_v, face.m_n[1]->m_v, face.m_n[2]->m_v, weights);
}

/// Fills what contacts of nodes and of faces have in common. They are filled as Bullet's own CollideSDF_RD
/// and CollideSDF_RDF do.
void fill(btSoftBody::DeformableRigidContact& contact, const SoftPoint& point, btRigidBody& rigid,
          const btVector3& arm, const Gap& gap) {
  contact.m_cti.m_colObj = &rigid;
  contact.m_cti.m_normal = gap.normal;
  contact.m_cti.m_offset = gap.distance - point.margin();
  contact.m_c1 = arm;
  contact.m_c3 = point.body->m_cfg.kDF * rigid.getFriction();
  contact.m_c4 = rigid.isStaticOrKinematicObject() ? point.body->m_cfg.kKHR : point.body->m_cfg.kCHR;
}

}  // namespace

btVector3 SoftPoint::velocity() const {
  return node != nullptr ? node->m_v : velocity_on(*face, weights);
}

void add_rigid_contact(const SoftPoint& point, const Eigen::Vector3d& place, btRigidBody& rigid,
                       const Gap& gap, btScalar time_step) {
  const btVector3 arm = to_bullet(place) - rigid.getWorldTransform().getOrigin();
  const btVector3 approach = point.velocity() - rigid.getVelocityInLocalPoint(arm);
  if (gap.distance + time_step * approach.dot(gap.normal) >= point.margin()) return;
  const btMatrix3x3& inertia = rigid.getInvInertiaTensorWorld();
  if (point.node != nullptr) {
    btSoftBody::DeformableNodeRigidContact contact;
    fill(contact, point, rigid, arm, gap);
    contact.m_node = point.node;
    contact.m_c2 = point.node->m_im;
    contact.m_c5 = point.node->m_effectiveMass_inv;
    contact.m_c0 = ImpulseMatrix(1, contact.m_c5, rigid.getInvMass(), inertia, arm);
    point.body->m_nodeRigidContacts.push_back(contact);
    return;
  }
  btSoftBody::DeformableFaceRigidContact contact;
  fill(contact, point, rigid, arm, gap);
  contact.m_face = point.face;
  contact.m_contactPoint = to_bullet(place);
  contact.m_bary = point.weights;
  contact.m_weights = 2 / (1 + point.weights.length2()) * point.weights;
  contact.m_c2 = 0;
  for (int i = 0; i < 3; ++i)
    contact.m_c2 += contact.m_bary[i] * contact.m_weights[i] * point.face->m_n[i]->m_im;
  contact.m_c5 = Diagonal(contact.m_c2);
  contact.m_c0 = ImpulseMatrix(1, contact.m_c2, rigid.getInvMass(), inertia, arm);
  point.body->m_faceRigidContacts.push_back(contact);
}

/// Bullet uses neither `m_weights`, `m_imf` nor `m_c0` of such contacts.
void add_soft_contact(const SoftPoint& vertex, const SoftPoint& surface, const Gap& gap, btScalar time_step) {
  const btVector3 approach = vertex.node->m_v - velocity_on(*surface.face, surface.weights);
  const btScalar margins = vertex.margin() + surface.margin();
  if (gap.distance + time_step * approach.dot(gap.normal) >= margins) return;
  btSoftBody::DeformableFaceNodeContact contact;
  contact.m_node = vertex.node;
  contact.m_face = surface.face;
  contact.m_bary = surface.weights;
  contact.m_weights.setZero();
  contact.m_normal = gap.normal;
  contact.m_margin = margins;
  contact.m_friction = vertex.body->m_cfg.kDF * surface.body->m_cfg.kDF;
  contact.m_imf = 0;
  contact.m_c0 = 0;
  contact.m_colObj = surface.body;
  vertex.body->m_faceNodeContacts.push_back(contact);
}

btScalar gap_after(const btSoftBody::DeformableFaceNodeContact& contact, btScalar time_step) {
  const auto apart = [&](btVector3 btSoftBody::Node::*member) {
    const btSoftBody::Face& face = *contact.m_face;
    return contact.m_node->*member -
           BaryEval(face.m_n[0]->*member, face.m_n[1]->*member, face.m_n[2]->*member, contact.m_bary);
  };
  return contact.m_normal.dot(apart(&btSoftBody::Node::m_x) + time_step * apart(&btSoftBody::Node::m_v));
}

}  // namespace examples::bullet
