#pragma once

#include "sweep/polynomial.hpp"
#include "sweep/swept_vectors.hpp"

namespace graze {

/// The polynomials in time whose signs say whether two features touch, in exact numbers.
template <typename Number>
class SweptPolynomials {
 public:
  explicit SweptPolynomials(const FeatureSweep& sweep) : sweep_(&sweep) {}

  /// A component of the vector between two points, of degree 1.
  [[nodiscard]] Polynomial<Number> component(Edge edge, int axis) const {
    const Eigen::Vector3d& from0 = point(sweep_->start, edge.from);
    const Eigen::Vector3d& from1 = point(sweep_->end, edge.from);
    const Number start = Number::difference(point(sweep_->start, edge.to)[axis], from0[axis]);
    const Number end = Number::difference(point(sweep_->end, edge.to)[axis], from1[axis]);
    return Polynomial<Number>(start, end - start);
  }

  /// A component of a cross product, of degree 2.
  [[nodiscard]] Polynomial<Number> cross(Edge first, Edge second, int axis) const {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    return component(first, next) * component(second, last) -
           component(first, last) * component(second, next);
  }

  /// A scalar product, of degree 2.
  [[nodiscard]] Polynomial<Number> dot(Edge first, Edge second) const {
    Polynomial<Number> sum;
    for (int axis = 0; axis < 3; ++axis) sum = sum + component(first, axis) * component(second, axis);
    return sum;
  }

  /// The volume that is 0 where the four points lie in a plane, of degree 3.
  [[nodiscard]] Polynomial<Number> volume(SweptPair pair) const {
    const std::array<Edge, 3>& edges = volume_edges_of(pair);
    Polynomial<Number> sum;
    for (int axis = 0; axis < 3; ++axis)
      sum = sum + component(edges[0], axis) * cross(edges[1], edges[2], axis);
    return sum;
  }

  [[nodiscard]] const FeatureSweep& sweep() const { return *sweep_; }

 private:
  const FeatureSweep* sweep_;
};

}  // namespace graze
