#pragma once

#include <graze/contact_geometry.hpp>
#include <memory>
#include <utility>

#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/shapes.hpp"
#include "support/mesh_of.hpp"

namespace graze::tests {

/// A shape with its mesh.
struct Placed {
  explicit Placed(oracle::Shape given) : shape(std::move(given)), mesh(mesh_of(shape)) {}
  oracle::Shape shape;
  std::shared_ptr<const Mesh> mesh;
};

inline Placed moved(const Placed& placed, const Eigen::Vector3d& offset) {
  return Placed(mapped(placed.shape, 1, offset));
}

inline ContactGeometry evaluate(const Placed& a, const Feature& feature_a, const Placed& b,
                                const Feature& feature_b) {
  return graze::evaluate(*a.mesh, a.shape.positions, feature_a, *b.mesh, b.shape.positions, feature_b);
}
inline ContactGeometry evaluate(const Placed& a, const Placed& b, const Contact& contact) {
  return graze::evaluate(*a.mesh, a.shape.positions, *b.mesh, b.shape.positions, contact);
}

inline PairAnswer contacts_of(const Placed& a, const Placed& b, ContactDetail detail, double threshold = 0.5,
                              const oracle::Solids& solids = {}) {
  PairQuery query = query_of(detail, threshold);
  query.a_is_solid = solids.a;
  query.b_is_solid = solids.b;
  return detect(surface_of(a.shape), surface_of(b.shape), query);
}

}  // namespace graze::tests
