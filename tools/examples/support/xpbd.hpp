#pragma once

#include <Eigen/Core>

#include "examples/support/body.hpp"

/// The parts of a step of XPBD: predict, then solve constraints as often as wanted, then update velocities.
/// See Macklin, Müller and Chentanez, XPBD, 2016.
namespace examples {

/// Moves vertices by their velocities, as if there were no springs and no contacts. Gravity pulls on what has
/// a finite mass. `damping` is how much of a velocity is lost in a second.
void predict(Body& body, const Eigen::Vector3d& gravity, double damping, double time_step);

/// Solves each spring once.
void solve_springs(Body& body, double time_step);

/// Computes velocities from where the vertices were at the beginning of the step and where they are now.
void update_velocities(Body& body, double time_step);

}  // namespace examples
