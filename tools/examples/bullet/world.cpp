#include "examples/bullet/world.hpp"

#include <chrono>

namespace examples::bullet {
namespace {

template <typename Find>
double milliseconds_of(const Find& find) {
  const auto begin = std::chrono::steady_clock::now();
  find();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

// The order of Bullet's own function, call by call.
void World::internalSingleStepSimulation(btScalar time_step) {
  reinitialize(time_step);
  applyRigidBodyGravity(time_step);
  predictUnconstraintMotion(time_step);
  StepFigures now;
  now.milliseconds += milliseconds_of([&] { find_rigid_contacts(time_step); });
  look();
  calculateSimulationIslands();
  beforeSolverCallbacks(time_step);
  solveConstraints(time_step);
  afterSolverCallbacks(time_step);
  now.milliseconds += milliseconds_of([&] { find_soft_contacts(time_step); });
  now.contacts = count_contacts();
  applyRepulsionForce(time_step);
  now.milliseconds += milliseconds_of([&] { stop_crossings(time_step); });
  integrateTransforms(time_step);
  updateActions(time_step);
  updateActivationState(time_step);
  figures_.push_back(now);
}

void World::find_rigid_contacts(btScalar /*time_step*/) {
  performDiscreteCollisionDetection();
}

void World::find_soft_contacts(btScalar /*time_step*/) {
  performDeformableCollisionDetection();
}

void World::stop_crossings(btScalar time_step) {
  performGeometricCollisions(time_step);
}

std::size_t World::count_contacts() {
  int count = 0;
  for (int i = 0; i < getSoftBodyArray().size(); ++i) {
    const btSoftBody& soft = *getSoftBodyArray()[i];
    count +=
        soft.m_nodeRigidContacts.size() + soft.m_faceRigidContacts.size() + soft.m_faceNodeContacts.size();
  }
  return static_cast<std::size_t>(count);
}

}  // namespace examples::bullet
