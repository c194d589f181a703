#include "examples/bullet/bodies.hpp"

#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableLinearElasticityForce.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "examples/support/shapes.hpp"

namespace examples::bullet {
namespace {

const btVector3 gravity(0, 0, -10);   // m/s²
constexpr double radius = 0.5;        // m, of a ball
constexpr btScalar ball_mass = 2;     // kg
constexpr btScalar stiffness = 2000;  // Pa, both of Lamé's parameters
constexpr btScalar friction = 0.5F;
constexpr double paddle_start = -1.45;     // m
constexpr double paddle_way = 0.5;         // m
constexpr double pace = std::numbers::pi;  // 1/s: there and back in 2 s

std::shared_ptr<const graze::Mesh> mesh_of(const Shape& shape) {
  return std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
}

int node_of(std::uint32_t vertex) {
  return static_cast<int>(vertex);
}

/// Settings as Bullet's own examples of elastic bodies have them.
void set_up(World& world) {
  world.setGravity(gravity);
  world.getWorldInfo().m_gravity = gravity;
  world.getWorldInfo().m_sparsesdf.setDefaultVoxelsz(0.05F);
  world.getWorldInfo().m_sparsesdf.Reset();  // takes the size up
  world.setImplicit(true);
  world.setUseProjection(true);
  world.getSolverInfo().m_deformable_erp = 0.3F;
  world.getSolverInfo().m_deformable_maxErrorReduction = 200;
  world.getSolverInfo().m_leastSquaresResidualThreshold = 1e-3F;
  world.getSolverInfo().m_splitImpulse = true;
  world.getSolverInfo().m_numIterations = 20;
}

}  // namespace

Eigen::Isometry3d pose_of(const btRigidBody& body) {
  const btQuaternion turn = body.getWorldTransform().getRotation();
  const Eigen::Quaterniond rotation(turn.w(), turn.x(), turn.y(), turn.z());
  return Eigen::Translation3d(to_eigen(body.getWorldTransform().getOrigin())) * rotation.normalized();
}

Bodies::Bodies(World& world, int collisions, double margin)
    : world_(world), collisions_(collisions), margin_(margin) {
  set_up(world_);
  add_pit();
  for (int i = 0; i < 8; ++i) {
    const int layer = i / 4;
    add_ball({(i % 2 == 0 ? -0.3 : 0.85) + 0.03 * layer, (i / 2 % 2 == 0 ? -0.54 : 0.54) + 0.02 * layer,
              0.54 + 1.08 * layer});
  }
}

Bodies::~Bodies() {
  for (const SoftPart& part : soft_) world_.removeSoftBody(part.body.get());
  for (const RigidPart& part : rigid_) world_.removeRigidBody(part.body.get());
}

void Bodies::add_pit() {
  const double wall = 0.5;
  const Eigen::Vector3d inner(3.2, 2.2, 2);
  add_box("floor", {6, 6, 1}, {0, 0, -0.5});
  for (const double side : {-1.0, 1.0}) {
    add_box("end", {wall, inner.y() + 2 * wall, inner.z()},
            {side * (inner.x() + wall) / 2, 0, inner.z() / 2});
    add_box("side", {inner.x(), wall, inner.z()}, {0, side * (inner.y() + wall) / 2, inner.z() / 2});
  }
  add_box("paddle", {0.2, inner.y() - 0.1, 1.6}, {paddle_start, 0, 0.85});
  rigid_.back().body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
}

void Bodies::move_paddle(double time) {
  btRigidBody& paddle = *rigid_.back().body;
  btTransform transform = paddle.getWorldTransform();
  const double x = paddle_start + paddle_way * (1 - std::cos(pace * time)) / 2;
  transform.getOrigin().setX(static_cast<btScalar>(x));
  paddle.setWorldTransform(transform);
  paddle.setInterpolationWorldTransform(transform);
  const double speed = paddle_way * pace * std::sin(pace * time) / 2;
  paddle.setLinearVelocity({static_cast<btScalar>(speed), 0, 0});
}

void Bodies::add_box(const char* name, const Eigen::Vector3d& size, const Eigen::Vector3d& at) {
  RigidPart& part = rigid_.emplace_back();
  part.name = name;
  part.mesh = mesh_of(box(size));
  part.shape = std::make_unique<btBoxShape>(to_bullet(size / 2));
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, part.shape.get());
  info.m_startWorldTransform.setOrigin(to_bullet(at));
  info.m_friction = friction;
  part.body = std::make_unique<btRigidBody>(info);
  part.body->setActivationState(DISABLE_DEACTIVATION);
  world_.addRigidBody(part.body.get());
}

void Bodies::add_force(btSoftBody& body, std::unique_ptr<btDeformableLagrangianForce> force) {
  world_.addForce(&body, force.get());
  forces_.push_back(std::move(force));
}

/// Adds a ball of tetrahedra about a node in its middle. graze reads no node that no face has.
void Bodies::add_ball(const Eigen::Vector3d& at) {
  Shape shape = moved(ball(radius, 20, 12), at);
  const auto middle = static_cast<std::uint32_t>(shape.points.size());
  shape.points.push_back(at);
  SoftPart& part = soft_.emplace_back();
  part.mesh = mesh_of(shape);
  std::vector<btVector3> points;
  for (const Eigen::Vector3d& point : shape.points) points.push_back(to_bullet(point));
  part.body = std::make_unique<btSoftBody>(&world_.getWorldInfo(), static_cast<int>(points.size()),
                                           points.data(), nullptr);
  btSoftBody& body = *part.body;
  for (const auto& [a, b, c] : shape.triangles) {
    body.appendFace(node_of(a), node_of(b), node_of(c));
    body.appendTetra(node_of(middle), node_of(a), node_of(b), node_of(c));
  }
  // The links have no force. Bullet makes its tree of nodes along them, and does not end if one has none.
  for (std::uint32_t i = 0; i < part.mesh->edge_count(); ++i)
    body.appendLink(node_of(part.mesh->edge(i)[0]), node_of(part.mesh->edge(i)[1]));
  for (std::uint32_t vertex = 0; vertex < middle; ++vertex) body.appendLink(node_of(middle), node_of(vertex));
  body.initializeDmInverse();
  body.m_tetraScratches.resize(body.m_tetras.size());
  body.m_tetraScratchesTn.resize(body.m_tetras.size());
  body.setTotalMass(ball_mass);
  body.getCollisionShape()->setMargin(static_cast<btScalar>(margin_));
  body.m_cfg.collisions = collisions_;
  body.m_cfg.kDF = friction;
  body.m_cfg.kKHR = 1;
  body.m_cfg.kCHR = 1;
  body.setSpringStiffness(100);
  body.setActivationState(DISABLE_DEACTIVATION);
  world_.addSoftBody(&body);
  add_force(body, std::make_unique<btDeformableGravityForce>(gravity));
  add_force(body, std::make_unique<btDeformableLinearElasticityForce>(stiffness, stiffness, 0.01F));
}

}  // namespace examples::bullet
