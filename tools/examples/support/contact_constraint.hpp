#pragma once

#include <deque>
#include <graze/graze.hpp>
#include <vector>

#include "examples/support/body.hpp"

namespace examples {

/// How contacts push.
struct ContactSettings {
  double gap = 0.005;         ///< how far surfaces stay apart, in m, less than the contact distance
  double friction = 0.5;      ///< the coefficient of Coulomb's friction
  double recovery_speed = 1;  ///< how fast what is too near is pushed out at most, in m/s
};

/// A contact for a solver that moves positions. Its separation along the direction of its push, when the two
/// objects have moved, is direction · (point of b − point of a). The points are carried along by the
/// vertices.
struct ContactConstraint {
  Body* a = nullptr;
  Body* b = nullptr;
  graze::Feature feature_a;
  graze::Feature feature_b;
  graze::SurfaceWeights weights_a;
  graze::SurfaceWeights weights_b;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double separation = 0;  ///< where the report saw it, or update() did
  bool is_plane = false;  ///< of a plane that `a` carries, in place of features: update() leaves it as it is
};

/// Replaces constraints by those of a report. `user_data` of each object is its index in `bodies`. Contacts
/// where an edge pierces a face are left out.
void collect_constraints(const graze::FrameReport& report, std::deque<Body>& bodies,
                         std::vector<ContactConstraint>& constraints);

/// Computes where the two features are now, without another step of graze. Where the closest points have left
/// the features, other features may be nearer by now. The constraint then stays that of the last positions.
void update(ContactConstraint& constraint);

/// Moves vertices of both bodies so that the contact is open as far as it should be, and holds back what
/// slides. A vertex moves as far as its weight and its inverse mass say.
void solve(const ContactConstraint& constraint, const ContactSettings& settings, double time_step);

}  // namespace examples
