#pragma once

#include <deque>
#include <graze/graze.hpp>
#include <vector>

#include "examples/support/body.hpp"

namespace examples {

/// How contacts push.
struct ContactSettings {
  double gap = 0.005;          ///< how far surfaces stay apart, in m; less than the contact distance
  double friction = 0.5;       ///< the coefficient of Coulomb's friction
  double recovery_speed = 1;   ///< how fast what is too near is pushed out at most, in m/s
};

/// A contact for a solver that moves positions. Its separation along the direction of its push, when the two
/// objects have moved, is direction · (point of b − point of a). The points are carried along by the vertices.
struct ContactConstraint {
  Body* a = nullptr;
  Body* b = nullptr;
  graze::SurfaceWeights weights_a;
  graze::SurfaceWeights weights_b;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double separation = 0;  ///< where the report saw it
};

/// Replaces constraints by those of a report. `user_data` of each object is its index in `bodies`.
void collect_constraints(const graze::FrameReport& report, std::deque<Body>& bodies,
                         std::vector<ContactConstraint>& constraints);

/// Moves vertices of both bodies so that the contact is open as far as it should be, and holds back what slides.
/// A vertex moves as far as its weight and its inverse mass say.
void solve(const ContactConstraint& constraint, const ContactSettings& settings, double time_step);

}  // namespace examples
