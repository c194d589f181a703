#pragma once

#include <Eigen/Core>

#include "support/oracle/oracle.hpp"

/// Brute force in plain double over all triangles of a surface. It shares no code with the library.
namespace graze::tests {

/// The distance of a point from a surface.
double distance_from_surface(const Eigen::Vector3d& point, const oracle::Shape& shape);

/// How often a closed surface that faces outward winds about a point, by the solid angles of its triangles.
double winding_about(const Eigen::Vector3d& point, const oracle::Shape& closed);

}  // namespace graze::tests
