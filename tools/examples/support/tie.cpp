#include "examples/support/tie.hpp"

#include <algorithm>

namespace examples {
namespace {

/// Returns the point that vertices carry by their weights.
Eigen::Vector3d carried(const graze::SurfaceWeights& weights, const Points& points) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.count); ++i)
    point += weights.weight[i] * points[weights.vertex[i]];
  return point;
}

/// Returns the inverse of the mass that a push at the point feels.
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

}  // namespace

Eigen::Vector3d Tie::apart() const {
  return carried(weights_b, b->positions) - carried(weights_a, a->positions);
}

void Tie::solve(const Eigen::Vector3d& wanted) const {
  const double yielding = inverse_mass(weights_a, *a) + inverse_mass(weights_b, *b);
  if (yielding == 0) return;
  const Eigen::Vector3d impulse = (wanted - apart()) / yielding;
  apply(weights_b, impulse, *b);
  apply(weights_a, -impulse, *a);
}

Tie tie_of(const graze::Contact& contact, Body& a, Body& b) {
  return {&a, &b, graze::weights(*a.mesh, a.positions, contact.feature_a, contact.point_a),
          graze::weights(*b.mesh, b.positions, contact.feature_b, contact.point_b)};
}

bool all_faces_in(std::uint8_t group, std::span<const std::uint8_t> groups, const graze::Mesh& mesh,
                  const graze::Feature& feature) {
  if (feature.kind == graze::FeatureKind::face) return groups[feature.index] == group;
  const auto faces = feature.kind == graze::FeatureKind::edge ? mesh.edge_faces(feature.index)
                                                              : mesh.vertex_faces(feature.index);
  return std::all_of(faces.begin(), faces.end(), [&](std::uint32_t face) { return groups[face] == group; });
}

}  // namespace examples
