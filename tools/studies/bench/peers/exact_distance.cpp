#include "bench/peers/exact_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graze::bench {
namespace {

struct Vector {
  double x, y, z;
};

Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator*(double factor, const Vector& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
double dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

constexpr int next[3] = {1, 2, 0};

struct Prepared {
  Vector corners[3];
  Vector edges[3];      ///< from each corner to the next
  double lengths[3];    ///< of the edges, squared
  Vector normal;        ///< not of unit length
  double area_squared;  ///< of the normal
};

Prepared prepare(const TrianglePoints& points, const double* origin) {
  Prepared result;
  for (int i = 0; i < 3; ++i)
    result.corners[i] = {points.corners[i][0] - origin[0], points.corners[i][1] - origin[1],
                         points.corners[i][2] - origin[2]};
  for (int i = 0; i < 3; ++i) {
    result.edges[i] = result.corners[next[i]] - result.corners[i];
    result.lengths[i] = dot(result.edges[i], result.edges[i]);
  }
  result.normal = cross(result.edges[0], result.edges[1]);
  result.area_squared = dot(result.normal, result.normal);
  return result;
}

/// The heights of a triangle's corners above another one's plane, times the length of its normal.
struct Heights {
  double of[3];
  /// All on one side.
  [[nodiscard]] bool on_one_side() const {
    return (of[0] > 0 && of[1] > 0 && of[2] > 0) || (of[0] < 0 && of[1] < 0 && of[2] < 0);
  }
  [[nodiscard]] double least() const { return std::min({std::abs(of[0]), std::abs(of[1]), std::abs(of[2])}); }
};

Heights heights_above(const Prepared& plane, const Prepared& triangle) {
  Heights heights;
  for (int i = 0; i < 3; ++i) heights.of[i] = dot(plane.normal, triangle.corners[i] - plane.corners[0]);
  return heights;
}

/// Whether a point of the triangle's plane, or its foot on it, is inside.
bool is_over(const Prepared& triangle, const Vector& point) {
  for (int i = 0; i < 3; ++i)
    if (dot(cross(triangle.normal, triangle.edges[i]), point - triangle.corners[i]) < 0) return false;
  return true;
}

/// Whether an edge of one triangle goes through the other.
bool pierces(const Prepared& triangle, const Prepared& other, const Heights& heights) {
  for (int i = 0; i < 3; ++i) {
    const double from = heights.of[i];
    const double to = heights.of[next[i]];
    if (!((from <= 0 && to >= 0) || (from >= 0 && to <= 0)) || from == to) continue;
    const double part = from / (from - to);
    if (is_over(triangle, other.corners[i] + part * other.edges[i])) return true;
  }
  return false;
}

double clamped(double value) {
  return std::min(std::max(value, 0.0), 1.0);
}

/// The squared distance of two segments: from `from` along `edge`, of squared length `length`.
double segment_distance_squared(const Vector& from, const Vector& edge, double length,
                                const Vector& other_from, const Vector& other_edge, double other_length) {
  const Vector between = from - other_from;
  const double mixed = dot(edge, other_edge);
  const double along = dot(edge, between);
  const double other_along = dot(other_edge, between);
  const double determinant = length * other_length - mixed * mixed;
  double s = determinant > 0 ? clamped((mixed * other_along - along * other_length) / determinant) : 0;
  double t = other_length > 0 ? (mixed * s + other_along) / other_length : 0;
  if (t < 0 || t > 1) {
    t = clamped(t);
    s = length > 0 ? clamped((mixed * t - along) / length) : 0;
  }
  const Vector gap = between + (s * edge - t * other_edge);
  return dot(gap, gap);
}

/// Returns the least squared height of those corners of `other` that lie over the triangle, or infinity if
/// none does.
double over_distance_squared(const Prepared& triangle, const Prepared& other, const Heights& heights) {
  double least = std::numeric_limits<double>::infinity();
  if (!(triangle.area_squared > 0)) return least;
  for (int i = 0; i < 3; ++i) {
    const double squared = heights.of[i] * heights.of[i] / triangle.area_squared;
    if (squared < least && is_over(triangle, other.corners[i])) least = squared;
  }
  return least;
}

}  // namespace

double triangle_distance(const TrianglePoints& points_a, const TrianglePoints& points_b, double limit) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double surely = 1 + 1e-9;
  const double limit_squared = limit * limit * surely;
  const Prepared a = prepare(points_a, points_a.corners[0]);
  const Prepared b = prepare(points_b, points_a.corners[0]);
  const Heights of_b = heights_above(a, b);
  const bool a_parts = of_b.on_one_side();
  if (a_parts && of_b.least() * of_b.least() > limit_squared * a.area_squared) return infinity;
  const Heights of_a = heights_above(b, a);
  const bool b_parts = of_a.on_one_side();
  if (b_parts && of_a.least() * of_a.least() > limit_squared * b.area_squared) return infinity;
  if (!a_parts && !b_parts && (pierces(a, b, of_b) || pierces(b, a, of_a))) return 0;
  double squared = std::min(over_distance_squared(a, b, of_b), over_distance_squared(b, a, of_a));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      squared = std::min(squared, segment_distance_squared(a.corners[i], a.edges[i], a.lengths[i],
                                                           b.corners[j], b.edges[j], b.lengths[j]));
  const double distance = std::sqrt(squared);
  return distance < limit ? distance : infinity;
}

}  // namespace graze::bench
