#pragma once

#include <Eigen/Core>
#include <array>
#include <graze/impact.hpp>
#include <optional>

#include "core/sweep/sweep_counters.hpp"
#include "core/sweep/sweep_precision.hpp"

namespace graze {

/// The four points of two features at time 0 and at time 1. Between these every point moves along a straight
/// line at a constant speed. Coordinates are finite and at most `largest_coordinate` in magnitude.
struct FeatureSweep {
  std::array<Eigen::Vector3d, 4> start, end;
};

/// The first time at which two features meet: lower ≤ time ≤ upper.
struct SweptMeeting {
  double lower = 0;
  double upper = 0;
  ImpactStatus status = ImpactStatus::certain;
};

/// Finds the first time in [0, 1] at which a point lies on a triangle. The order of points is v, f0, f1, f2.
/// Returns nothing where they do not meet, which is decided as in real arithmetic. A triangle without area is
/// the segment or the point that it spans. Allocates nothing.
std::optional<SweptMeeting> meet_vertex_face(const FeatureSweep& sweep, const SweepPrecision& precision,
                                             SweepCounters& counters);

/// Finds the first time in [0, 1] at which two segments have a common point. The order of points is a0, a1,
/// b0, b1. A segment without length is a point. Otherwise like meet_vertex_face().
std::optional<SweptMeeting> meet_edge_edge(const FeatureSweep& sweep, const SweepPrecision& precision,
                                           SweepCounters& counters);

/// Returns a lower bound of the first time in [0, 1] at which the distance of a point and a triangle is at
/// most `gap`, which is not negative. It is 0 where they are that near at the start. Returns nothing where
/// they certainly never come that near. Allocates nothing.
std::optional<double> approach_vertex_face(const FeatureSweep& sweep, double gap);

/// Finds that time for two segments. Otherwise like approach_vertex_face().
std::optional<double> approach_edge_edge(const FeatureSweep& sweep, double gap);

}  // namespace graze
