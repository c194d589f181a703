#pragma once

#include <Eigen/Core>
#include <functional>

namespace graze::models {

/// A body by its signed distance, roughly: negative inside, and about the distance near the surface.
using Field = std::function<double(const Eigen::Vector3d&)>;

/// A body between two balls and around the way from one to the other.
double limb(const Eigen::Vector3d& p, const Eigen::Vector3d& from, double from_radius,
            const Eigen::Vector3d& to, double to_radius);

double ellipsoid(const Eigen::Vector3d& p, const Eigen::Vector3d& centre, const Eigen::Vector3d& radii);

/// The union of two bodies, the seam filled over about `width`.
double blended(double first, double second, double width);

/// The first body without the second, the rim rounded over about `width`.
double carved(double body, double tool, double width);

/// The point of the surface that is near `p`.
Eigen::Vector3d on_surface(const Field& field, Eigen::Vector3d p);

/// Outward, of unit length.
Eigen::Vector3d normal_at(const Field& field, const Eigen::Vector3d& p);

}  // namespace graze::models
