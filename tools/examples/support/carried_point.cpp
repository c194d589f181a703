#include "examples/support/carried_point.hpp"

namespace examples {

Eigen::Vector3d carried(const graze::SurfaceWeights& weights, const Points& points) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.count); ++i)
    point += weights.weight[i] * points[weights.vertex[i]];
  return point;
}

double inverse_mass(const graze::SurfaceWeights& weights, const Body& body) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.count); ++i)
    sum += weights.weight[i] * weights.weight[i] * body.inverse_masses[weights.vertex[i]];
  return sum;
}

void apply(const graze::SurfaceWeights& weights, const Eigen::Vector3d& impulse, Body& body) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.count); ++i)
    body.positions[weights.vertex[i]] += weights.weight[i] * body.inverse_masses[weights.vertex[i]] * impulse;
}

}  // namespace examples
