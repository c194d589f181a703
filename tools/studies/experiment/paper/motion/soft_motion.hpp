#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// A body before it moves.
struct SoftBody {
  std::string name;
  std::string kind;
  std::uint32_t kind_id = 0;
  models::MeshData rest;
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  /// The velocity at x is `flow` times x less the middle of the body.
  Eigen::Matrix3d flow = Eigen::Matrix3d::Zero();
  double speed = 0;  ///< at which it goes to the meeting point, in units a step
  bool soft = true;  ///< false: it stands still, and never gives way
};

/// Bodies that come together at one point, deforming as mass-spring bodies do, and push each other off where
/// they are close.
struct SoftMotion {
  std::string name;
  std::vector<SoftBody> bodies;
  Eigen::Vector3d meeting_point = Eigen::Vector3d::Zero();
  double stiffness = 1;  ///< of structural springs. Those of bends have half of it
  double gap = 0;        ///< surfaces nearer than this push each other off
  double push = 0;       ///< force by what is missing to the gap, of each contact
  std::size_t steps = 0;
};

/// Plays a motion and records `frames` of its steps, evenly chosen, the first and the last among them. Exact
/// mode guides it: its contacts below the gap are where bodies push. Where two surfaces come nearer than a
/// quarter of a unit or pierce each other, all stand still from there on. The paper too stops its
/// simulation "to avoid penetrations". Positions are rounded to multiples of 2^-14. So float holds them, and
/// double the squares of their distances, without a further error. They must stay within 512.
RecordedMotion record_soft_motion(const SoftMotion& motion, std::size_t frames);

}  // namespace graze::tools
