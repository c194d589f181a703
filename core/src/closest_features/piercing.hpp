#pragma once

#include <optional>
#include <span>

#include "closest_features/closest_features.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// The triangle of a face, one of its one or two, that a segment passes through. Returns nothing where there
/// is none. The segment's ends lie strictly on opposite sides of the triangle's plane, and the crossing is
/// inside the face. That is so at the side where two triangles meet, if it is a fold. Where a bent quad is
/// pierced twice, the crossing nearer the segment's first point counts.
std::optional<Piece> pierced_triangle(const Simplex& segment, std::span<const Simplex> triangles,
                                      bool has_fold, DecisionCount& count);

/// The piece of a face that an edge or fold of the other surface pierces, by the rule above. No value where
/// it pierces none.
std::optional<FeaturePiece> pierced_piece(const Surface& surface, const FeaturePiece& segment,
                                          const Surface& other, std::uint32_t face, DecisionCount& count);

/// How far along segment p-q the plane of a triangle is: the signed volumes of p and q over it. For a
/// piercing segment the crossing is at numerator / denominator of the way from p to q, with a positive
/// denominator.
template <typename Number>
Ratio<Number> crossing_parameter(const Simplex& segment, const Simplex& triangle, bool& unsure) {
  const Vector<Number> normal = normal_of_corners<Number>(triangle.point);
  const Number at_p = dot(normal, difference<Number>(segment.point[0], triangle.point[0]));
  const Number at_q = dot(normal, difference<Number>(segment.point[1], triangle.point[0]));
  if (sign(at_p, unsure) < 0) return {-at_p, at_q - at_p};
  return {at_p, at_p - at_q};
}

}  // namespace graze
