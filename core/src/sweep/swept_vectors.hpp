#pragma once

#include "arithmetic/arithmetic.hpp"
#include "sweep/feature_signs.hpp"
#include "sweep/moving_features.hpp"

namespace graze {

inline const Eigen::Vector3d& point(const std::array<Eigen::Vector3d, 4>& points, int index) {
  return points[static_cast<std::size_t>(index)];
}

/// The vector between two of the four points, at time 0 and at time 1. In between it is linear in time.
template <typename Number>
struct SweptVector {
  Vector<Number> start;
  Vector<Number> end;

  SweptVector(const FeatureSweep& sweep, Edge edge)
      : start(difference<Number>(point(sweep.start, edge.to), point(sweep.start, edge.from))),
        end(difference<Number>(point(sweep.end, edge.to), point(sweep.end, edge.from))) {}

  [[nodiscard]] Vector<Number> at(const Number& time) const { return start + (end - start) * time; }
};

/// The three vectors whose volume is 0 where the four points lie in a plane.
inline constexpr std::array<std::array<Edge, 3>, 2> volume_edges = {{
    {{{1, 0}, {1, 2}, {1, 3}}},  // vertex_face: from a corner to the point and along two sides
    {{{0, 2}, {0, 1}, {2, 3}}},  // edge_edge: from one segment to the other, and along both
}};
constexpr const std::array<Edge, 3>& volume_edges_of(SweptPair pair) {
  return volume_edges[static_cast<std::size_t>(pair)];
}

}  // namespace graze
