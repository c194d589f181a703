#pragma once

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableLagrangianForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

#include <Eigen/Geometry>
#include <graze/mesh.hpp>
#include <memory>
#include <string>
#include <vector>

#include "examples/bullet/world.hpp"

namespace examples::bullet {

inline btVector3 to_bullet(const Eigen::Vector3d& vector) {
  return {static_cast<btScalar>(vector.x()), static_cast<btScalar>(vector.y()),
          static_cast<btScalar>(vector.z())};
}

inline Eigen::Vector3d to_eigen(const btVector3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

/// Returns the pose of a rigid body.
Eigen::Isometry3d pose_of(const btRigidBody& body);

/// A soft ball, and the mesh of its faces. Each vertex of the mesh is a node of the body.
struct SoftPart {
  std::shared_ptr<const graze::Mesh> mesh;
  std::unique_ptr<btSoftBody> body;
};

/// A rigid box, and its mesh.
struct RigidPart {
  std::string name;
  std::shared_ptr<const graze::Mesh> mesh;
  std::unique_ptr<btCollisionShape> shape;
  std::unique_ptr<btRigidBody> body;
};

/// The parts that a world of Bullet's needs. They have to outlive it.
struct Engine {
  Engine() { constraints.setDeformableSolver(&bodies); }

  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btDeformableBodySolver bodies;
  btDeformableMultiBodyConstraintSolver constraints;
};

/// Eight soft balls that fall into a pit, where a paddle moves to and fro.
class Bodies {
 public:
  /// Fills a world, which has to be empty and to outlive this. The flags are `fCollision` of Bullet's: what
  /// its own detection is to find. The margin is in metres. Bullet keeps a ball that far from rigid bodies,
  /// and twice as far from another ball.
  Bodies(World& world, int collisions, double margin);
  ~Bodies();
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  [[nodiscard]] const std::vector<SoftPart>& soft() const { return soft_; }
  [[nodiscard]] const std::vector<RigidPart>& rigid() const { return rigid_; }

  [[nodiscard]] double margin() const { return margin_; }

  /// Moves the paddle to where it is at a time in seconds.
  void move_paddle(double time);

 private:
  void add_pit();
  void add_ball(const Eigen::Vector3d& at);
  void add_box(const char* name, const Eigen::Vector3d& size, const Eigen::Vector3d& at);
  void add_force(btSoftBody& body, std::unique_ptr<btDeformableLagrangianForce> force);

  World& world_;
  int collisions_;
  double margin_;
  std::vector<SoftPart> soft_;
  std::vector<RigidPart> rigid_;  ///< the paddle is the last one
  std::vector<std::unique_ptr<btDeformableLagrangianForce>> forces_;
};

/// A world of one kind with its bodies.
template <typename WorldKind>
struct Simulation {
  Simulation(int collisions, double margin)
      : world(&engine.dispatcher, &engine.broadphase, &engine.constraints, &engine.configuration,
              &engine.bodies),
        bodies(world, collisions, margin) {}

  /// Plays a sixtieth of a second.
  void play_frame(int steps) {
    for (int i = 0; i < steps; ++i) {
      const double time_step = 1.0 / 60 / steps;
      time += time_step;
      bodies.move_paddle(time);
      world.stepSimulation(static_cast<btScalar>(time_step), 0);  // one step of just this length
    }
  }

  Engine engine;
  WorldKind world;
  Bodies bodies;
  double time = 0;  ///< s
};

}  // namespace examples::bullet
