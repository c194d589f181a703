#pragma once

#include <Eigen/Core>
#include <graze/graze.hpp>

#include "examples/support/body.hpp"

namespace examples {

/// Returns the point that vertices carry by their weights.
Eigen::Vector3d carried(const graze::SurfaceWeights& weights, const Points& points);

/// Returns the inverse of the mass that a push at the point feels.
double inverse_mass(const graze::SurfaceWeights& weights, const Body& body);

/// Moves the vertices of the point by an impulse of positions, as far as their weights and inverse masses
/// say.
void apply(const graze::SurfaceWeights& weights, const Eigen::Vector3d& impulse, Body& body);

}  // namespace examples
