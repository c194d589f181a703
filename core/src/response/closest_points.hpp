#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "response/feature_points.hpp"

namespace graze {

// Closest points of simplices in plain double, as in Ericson, "Real-Time Collision Detection", chapter 5.
// What evaluate() calls for most contacts is inline: a call takes a tenth of its time.

struct SegmentPoint {
  Eigen::Vector3d point;
  double parameter;  ///< 0 at the start of the segment, 1 at its end
  bool is_interior;
};

inline SegmentPoint closest_on_segment(const Eigen::Vector3d& point, const Segment& segment) {
  const auto& [start, end] = segment;
  const Eigen::Vector3d along = end - start;
  const double numerator = along.dot(point - start);
  const double denominator = along.squaredNorm();
  if (!(numerator > 0)) return {start, 0, false};
  if (!(numerator < denominator)) return {end, 1, false};
  const double parameter = numerator / denominator;
  return {start + along * parameter, parameter, true};
}

/// Says where in a triangle a point lies.
enum class TrianglePart : std::uint8_t { corner, edge_01, edge_12, edge_20, inside };

struct TrianglePoint {
  Eigen::Vector3d gap;  ///< from the triangle to the point
  TrianglePart part;
  double height = 0;  ///< where the part is `inside`: has the sign of the point's side by the winding
};

/// Finds the closest point on the sides of a triangle. One without area has no other points.
TrianglePoint closest_on_sides(const Eigen::Vector3d& point, const TrianglePoints& triangle);

inline TrianglePoint closest_on_triangle(const Eigen::Vector3d& point, const TrianglePoints& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d from_a = point - a;
  const double a1 = ab.dot(from_a);
  const double a2 = ac.dot(from_a);
  if (a1 <= 0 && a2 <= 0) return {from_a, TrianglePart::corner};
  const Eigen::Vector3d from_b = point - b;
  const double b1 = ab.dot(from_b);
  const double b2 = ac.dot(from_b);
  if (b1 >= 0 && b2 <= b1) return {from_b, TrianglePart::corner};
  if (a1 * b2 - b1 * a2 <= 0 && a1 >= 0 && b1 <= 0 && a1 > b1)
    return {from_a - ab * (a1 / (a1 - b1)), TrianglePart::edge_01};
  const Eigen::Vector3d from_c = point - c;
  const double c1 = ab.dot(from_c);
  const double c2 = ac.dot(from_c);
  if (c2 >= 0 && c1 <= c2) return {from_c, TrianglePart::corner};
  if (c1 * a2 - a1 * c2 <= 0 && a2 >= 0 && c2 <= 0 && a2 > c2)
    return {from_a - ac * (a2 / (a2 - c2)), TrianglePart::edge_20};
  if (b1 * c2 - c1 * b2 <= 0 && b2 >= b1 && c1 >= c2 && b2 - b1 > c2 - c1)
    return {from_b - (c - b) * ((b2 - b1) / ((b2 - b1) + (c1 - c2))), TrianglePart::edge_12};
  const Eigen::Vector3d normal = area_normal(triangle);
  const double area = normal.squaredNorm();
  if (!(area > 0)) return closest_on_sides(point, triangle);
  const double height = normal.dot(from_a);
  return {normal * (height / area), TrianglePart::inside, height};
}

/// Two closest points, and whether each lies inside its simplex.
struct ClosestPoints {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  Eigen::Vector3d gap;  ///< b - a, but with a true direction where rounding leaves none in the difference
  bool are_interior;
  std::int8_t pierced_triangle = -1;  ///< of the face that an edge pierces, or -1
  double height = 0;  ///< of a vertex and a triangle: that of TrianglePoint, which spares a second normal

  [[nodiscard]] ClosestPoints swapped() const { return {b, a, -gap, are_interior, pierced_triangle, height}; }
};

/// Finds the closest points of segments that are parallel, or that are not closest inside both.
ClosestPoints closest_of_ends(const Segment& a, const Segment& b, bool are_parallel);

/// Whether the cross product of two edges, of this square, is what rounding leaves for parallel ones.
inline bool are_parallel(const Eigen::Vector3d& along_a, const Eigen::Vector3d& along_b,
                         double squared_cross) {
  return !(squared_cross > 0x1p-90 * along_a.squaredNorm() * along_b.squaredNorm());
}

inline ClosestPoints closest_of_segments(const Segment& a, const Segment& b) {
  const Eigen::Vector3d along_a = a[1] - a[0];
  const Eigen::Vector3d along_b = b[1] - b[0];
  const Eigen::Vector3d between = b[0] - a[0];
  const Eigen::Vector3d across = along_a.cross(along_b);
  const double squared = across.squaredNorm();
  // The cross product of parallel edges says nothing of where they are closest.
  const bool parallel = are_parallel(along_a, along_b, squared);
  const double s = between.cross(along_b).dot(across);
  const double t = between.cross(along_a).dot(across);
  if (parallel || !(s > 0 && s < squared && t > 0 && t < squared)) return closest_of_ends(a, b, parallel);
  const double scale = 1 / squared;
  return {a[0] + along_a * (s * scale), b[0] + along_b * (t * scale), across * (across.dot(between) * scale),
          true};
}

/// Finds the closest points of a segment and a triangle that it does not pierce. One of them is not inside
/// its simplex.
ClosestPoints closest_of_segment_and_triangle(const Segment& segment, const TrianglePoints& triangle);

}  // namespace graze
