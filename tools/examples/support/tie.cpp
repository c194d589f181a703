#include "examples/support/tie.hpp"

#include <algorithm>

#include "examples/support/carried_point.hpp"

namespace examples {
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
