#pragma once

#include "arithmetic/arithmetic.hpp"
#include "closest_features/closest_features.hpp"

namespace graze {

/// The squared distance of two pieces whose closest points lie in both relative interiors, which is that of
/// their affine hulls. The hulls are two points, a point and a line, a point and a plane, or two lines that
/// are not parallel.
template <typename Number>
Ratio<Number> hull_distance_squared(const Simplex& a, const Simplex& b) {
  const Simplex& low = a.size <= b.size ? a : b;
  const Simplex& high = a.size <= b.size ? b : a;
  const Vector<Number> offset = difference<Number>(low.point[0], high.point[0]);
  if (high.size == 1) return {dot(offset, offset), Number(1.0)};
  const Vector<Number> direction = difference<Number>(high.point[1], high.point[0]);
  if (low.size == 1 && high.size == 2) {
    const Vector<Number> area = cross(direction, offset);
    return {dot(area, area), dot(direction, direction)};
  }
  const Vector<Number> other = high.size == 3 ? difference<Number>(high.point[2], high.point[0])
                                              : difference<Number>(low.point[1], low.point[0]);
  const Vector<Number> normal = cross(direction, other);
  const Number volume = dot(normal, offset);
  return {volume * volume, dot(normal, normal)};
}

}  // namespace graze
