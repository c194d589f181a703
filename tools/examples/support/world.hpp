#pragma once

#include <deque>
#include <graze/graze.hpp>
#include <vector>

#include "examples/support/body.hpp"
#include "examples/support/contact_constraint.hpp"

namespace examples {

struct WorldSettings {
  double contact_distance = 0.02;  ///< in m: the gap, and how far surfaces come nearer in one step
  double gravity = 9.81;           ///< in m/s², downwards
  double damping = 0.1;            ///< how much of a velocity is lost in a second
  int substeps = 1;                ///< into which a step is cut. graze looks once for all of them
  int iterations = 1;              ///< over springs and contacts in each substep
  ContactSettings contacts;
};

/// Bodies that move by XPBD: Müller, Heidelberger, Hennix and Ratcliff, Position Based Dynamics, 2007, and
/// Macklin, Müller and Chentanez, XPBD, 2016. Each step asks graze for the nearest contacts first.
class World {
 public:
  explicit World(const WorldSettings& settings);

  /// Adds a body, and returns it as it is in the world.
  Body& add(Body body);

  /// Moves all bodies by a time step in seconds. Returns what graze saw at the beginning of it.
  graze::ReportHandle step(double time_step);

  /// Returns what graze sees now, and moves nothing.
  graze::ReportHandle look() { return scene_.step(); }

  /// Moves all bodies by a time step, under constraints that were found at its beginning, and updates these.
  /// `step` does so with those that graze finds.
  void move(std::vector<ContactConstraint>& constraints, double time_step);

  [[nodiscard]] graze::Scene& scene() { return scene_; }
  [[nodiscard]] std::deque<Body>& bodies() { return bodies_; }
  [[nodiscard]] const std::deque<Body>& bodies() const { return bodies_; }

 private:
  void substep(const std::vector<ContactConstraint>& constraints, double time_step);

  WorldSettings settings_;
  graze::Scene scene_;
  std::deque<Body> bodies_;  ///< a deque, since constraints and programs point to bodies
  std::vector<ContactConstraint> constraints_;
};

}  // namespace examples
