#pragma once

#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>

#include <cstddef>
#include <functional>
#include <vector>

/// Bullet's deformable bodies, with Bullet's own detection or with graze in its place.
namespace examples::bullet {

/// The time that the detection of one step took, and how much it found.
struct StepFigures {
  double milliseconds = 0;
  std::size_t contacts = 0;  ///< that Bullet's solver was given
};

/// Bullet's world with its own detection. A step is that of Bullet, which also takes the time.
class World : public btDeformableMultiBodyDynamicsWorld {
 public:
  using btDeformableMultiBodyDynamicsWorld::btDeformableMultiBodyDynamicsWorld;

  /// Returns the figures of all steps so far.
  [[nodiscard]] const std::vector<StepFigures>& figures() const { return figures_; }

  /// Is called in each step before a node moves, and not timed.
  std::function<void()> look = [] {};

 protected:
  void internalSingleStepSimulation(btScalar time_step) override;

  /// Fills the contacts of soft bodies with rigid ones, and those of rigid bodies.
  virtual void find_rigid_contacts(btScalar time_step);
  /// Fills the contacts of soft bodies with each other. Nodes have new velocities by then, and their places
  /// are still those of the last step.
  virtual void find_soft_contacts(btScalar time_step);
  /// Repeats the pushes of soft contacts where nodes would pass through faces in this step.
  virtual void stop_crossings(btScalar time_step);

 private:
  [[nodiscard]] std::size_t count_contacts();

  std::vector<StepFigures> figures_;
};

}  // namespace examples::bullet
