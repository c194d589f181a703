#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "arithmetic/certain.hpp"
#include "support/exact/exact.hpp"

/// Finds the Voronoi regions in which the closest points of two features lie, in rational arithmetic.
namespace graze::tests {

template <std::size_t Corners>
using ExactCorners = std::array<oracle::Point, Corners>;
template <std::size_t Corners>
ExactCorners<Corners> exact_corners(const std::array<Eigen::Vector3d, Corners>& corners) {
  ExactCorners<Corners> exact;
  for (std::size_t i = 0; i < Corners; ++i) exact[i] = oracle::exact(corners[i]);
  return exact;
}

/// The point of a triangle nearest to another: that of the inside where the foot of the perpendicular is
/// strictly inside, otherwise that of the nearest side.
struct NearestInTriangle {
  VoronoiRegion voronoi{};
  oracle::Rational squared_distance;
};
NearestInTriangle nearest_in_triangle(const oracle::Point& point, const ExactCorners<3>& corner);

/// The closest points of two segments: one pair, or one of several.
struct NearestOfSegments {
  std::array<Along, 2> along{};
  oracle::Rational squared_distance;
  bool is_unique = true;
};
NearestOfSegments nearest_of_segments(const ExactCorners<2>& a, const ExactCorners<2>& b);

/// How a segment goes from one side of a triangle's plane to the other, if it does: beside the triangle,
/// through its border or through its inside.
enum class Crossing { none, beside, border, inside };
Crossing crossing_of(const ExactCorners<2>& segment, const ExactCorners<3>& corner);
inline bool passes(const ExactCorners<2>& segment, const ExactCorners<3>& corner) {
  return crossing_of(segment, corner) == Crossing::inside;
}

}  // namespace graze::tests
