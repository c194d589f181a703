#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "support/oracle/integer_polynomial.hpp"

namespace graze::oracle {

/// Four points that move along straight lines from time 0 to time 1. They are a vertex and a triangle, or the
/// ends of two edges.
struct MovingPoints {
  std::array<Eigen::Vector3d, 4> start, end;
  bool are_edges = false;
};

/// The first time in [0, 1] at which the two features have a common point.
std::optional<AlgebraicTime> first_meeting(const MovingPoints& points);

/// Whether the features have a common point at a rational time.
bool touch_at(const MovingPoints& points, const Rational& time);

/// The squared distance of the features at a rational time.
Rational squared_distance_at(const MovingPoints& points, const Rational& time);

}  // namespace graze::oracle
