#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>

#include "bench/peers/rigid_bodies/placed_hull.hpp"

namespace graze::bench {

/// The face of one body from which the other one is furthest.
struct FaceAxis {
  double separation = -std::numeric_limits<double>::infinity();
  std::uint32_t face = 0;
};

/// The two edges across which the bodies are furthest apart.
struct EdgeAxis {
  double separation = -std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal;  ///< from a to b
  Eigen::Vector3d point_a, along_a;
  Eigen::Vector3d point_b, along_b;
};

/// The best axes that separate two convex bodies, of each kind.
struct SeparatingAxes {
  FaceAxis a, b;
  EdgeAxis edges;
};

/// Returns the axes, or none if one of them shows that the bodies are not nearer than a distance. Two boxes
/// have 15 axes. Otherwise these are the normals of all faces, and of edges those whose arcs cross on the
/// sphere of normals (Gregorius, The Separating Axis Test between Convex Polyhedra, 2013).
std::optional<SeparatingAxes> separating_axes(const PlacedHull& a, const PlacedHull& b, double distance);

}  // namespace graze::bench
