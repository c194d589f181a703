#include "core/answers/nearest_voronoi.hpp"

#include <algorithm>
#include <optional>

namespace graze::tests {
namespace {

using oracle::Point;
using oracle::Rational;
using oracle::squared_length;

/// Returns how far along segment (p, q) its point nearest to x lies, from 0 to 1.
Rational nearest_on_segment(const Point& x, const Point& p, const Point& q) {
  const Rational length_squared = squared_length(q - p);
  if (length_squared == 0) return 0;
  return std::clamp<Rational>(dot(q - p, x - p) / length_squared, 0, 1);
}

Point on_segment(const Point& p, const Point& q, const Rational& t) {
  return p + t * (q - p);
}

bool is_inside(const Rational& t) {
  return sgn(t) > 0 && t < 1;
}

Along along_of(const Rational& t) {
  if (t == 0) return Along::first;
  return t == 1 ? Along::second : Along::inside;
}

Along end_of(std::size_t end) {
  return end == 0 ? Along::first : Along::second;
}

/// On which side of a triangle's side, seen along its normal, a point is: 1 is that of the inside.
int turn(const Point& normal, const Point& from, const Point& to, const Point& point) {
  return sgn(dot(normal, cross(to - from, point - from)));
}
int least_turn(const Point& normal, const ExactCorners<3>& c, const Point& point) {
  int least = 1;
  for (std::size_t i = 0; i < 3 && least >= 0; ++i)
    least = std::min(least, turn(normal, c[i], c[(i + 1) % 3], point));
  return least;
}

}  // namespace

NearestInTriangle nearest_in_triangle(const Point& point, const ExactCorners<3>& c) {
  const Point normal = cross(c[1] - c[0], c[2] - c[0]);
  if (!is_zero(normal) && least_turn(normal, c, point) > 0) {
    const Rational height = dot(normal, point - c[0]);
    return {VoronoiRegion::inside, height * height / squared_length(normal)};
  }
  std::optional<NearestInTriangle> best;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational t = nearest_on_segment(point, c[i], c[(i + 1) % 3]);
    const Rational distance = squared_length(point - on_segment(c[i], c[(i + 1) % 3], t));
    auto voronoi = static_cast<VoronoiRegion>(static_cast<std::size_t>(VoronoiRegion::edge01) + i);
    if (t == 0) voronoi = static_cast<VoronoiRegion>(i);
    if (t == 1) voronoi = static_cast<VoronoiRegion>((i + 1) % 3);
    if (!best || distance < best->squared_distance ||
        (distance == best->squared_distance && voronoi < best->voronoi))
      best = NearestInTriangle{voronoi, distance};
  }
  return *best;
}

NearestOfSegments nearest_of_segments(const ExactCorners<2>& a, const ExactCorners<2>& b) {
  const Point u = a[1] - a[0];
  const Point v = b[1] - b[0];
  const Point w = b[0] - a[0];
  const Point normal = cross(u, v);
  const Rational determinant = squared_length(normal);
  if (determinant != 0) {
    const Rational s = dot(cross(w, v), normal) / determinant;
    const Rational t = dot(cross(w, u), normal) / determinant;
    if (is_inside(s) && is_inside(t)) {
      const Rational height = dot(normal, w);
      return {{Along::inside, Along::inside}, height * height / determinant};
    }
  }
  std::optional<NearestOfSegments> best;
  const auto offer = [&](Along of_a, Along of_b, const Rational& distance) {
    if (!best || distance < best->squared_distance)
      best = NearestOfSegments{{of_a, of_b}, distance};
    else if (distance == best->squared_distance && best->along != std::array{of_a, of_b})
      best->is_unique = false;
  };
  for (std::size_t end = 0; end < 2; ++end) {
    const Rational t = nearest_on_segment(a[end], b[0], b[1]);
    offer(end_of(end), along_of(t), squared_length(a[end] - on_segment(b[0], b[1], t)));
    const Rational s = nearest_on_segment(b[end], a[0], a[1]);
    offer(along_of(s), end_of(end), squared_length(b[end] - on_segment(a[0], a[1], s)));
  }
  return *best;
}

Crossing crossing_of(const ExactCorners<2>& segment, const ExactCorners<3>& c) {
  const Point normal = cross(c[1] - c[0], c[2] - c[0]);
  const Rational first = dot(normal, segment[0] - c[0]);
  const Rational second = dot(normal, segment[1] - c[0]);
  if (sgn(first) * sgn(second) >= 0) return Crossing::none;
  const int least = least_turn(normal, c, on_segment(segment[0], segment[1], first / (first - second)));
  if (least < 0) return Crossing::beside;
  return least > 0 ? Crossing::inside : Crossing::border;
}

}  // namespace graze::tests
