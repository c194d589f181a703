#pragma once

#include <optional>
#include <vector>

#include "support/exact/exact_shape.hpp"

namespace graze::oracle {

/// The point of something that is closest to a given point, and the feature that holds it.
struct Foot {
  Feature feature;
  Point point;
  Rational distance_squared;
};

/// The closest point of a face, both triangles and the diagonal included. Ties go to the lowest dimension,
/// the lowest index, the first triangle.
Foot foot_on_face(const Point& point, const ExactShape& shape, std::uint32_t face);

/// The closest point of a segment. A segment without length is its first end.
Foot foot_on_segment(const Point& point, const ExactShape& shape, const Segment& segment);

/// A point on each of two segments, and the features that hold them.
struct SegmentContact {
  Foot a;  ///< `distance_squared` is the same in both
  Foot b;
};

/// The closest points of two segments where they are unique and inside both. The features are the owners.
std::optional<SegmentContact> inner_contact(const ExactShape& a, const Segment& segment_a,
                                            const ExactShape& b, const Segment& segment_b);

/// The pairs of an end of one segment and its foot on the other that are closest of all: for parallel
/// segments the ends of their common stretch. Not empty. The distance is that of the segments unless they
/// have an inner contact.
std::vector<SegmentContact> end_contacts(const ExactShape& a, const Segment& segment_a, const ExactShape& b,
                                         const Segment& segment_b);

/// Finds where a segment crosses a triangle of `face` strictly inside or on the inner diagonal. The ends of
/// the segment lie strictly on opposite sides of the triangle. Returns the fraction of the way from its first
/// end, the smallest if there are two.
std::optional<Rational> crossing(const ExactShape& shape, const Segment& segment, const ExactShape& other,
                                 std::uint32_t face);

/// The point at fraction `t` of the way from a segment's first to its second end.
Point point_at(const ExactShape& shape, const Segment& segment, const Rational& t);

}  // namespace graze::oracle
