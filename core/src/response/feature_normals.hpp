#pragma once

#include <Eigen/Core>

#include "response/feature_points.hpp"

namespace graze {

// Normals in plain double, not normalised, and zero where there are none. Those of edges and vertices are
// angle-weighted (Baerentzen and Aanaes, "Signed distance computation using the angle weighted
// pseudonormal").

/// The unit normal of a triangle by its winding, or zero.
Eigen::Vector3d unit_normal(const TrianglePoints& triangle);

/// The side of a feature to which `direction` leads from `point` on it, by the normal there. It is `none`
/// where double cannot be sure of the sign, as in a report, and where there is no direction. Most sides need
/// neither a square root nor an angle.
Side side_along(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& point,
                const Eigen::Vector3d& direction);

/// The normal of a feature where `point` lies on it: for a quad that of the triangle that holds the point, or
/// the sum of both on the inner diagonal.
Eigen::Vector3d normal_at(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& point);

}  // namespace graze
