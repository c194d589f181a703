#include "support/oracle/oracle_swept.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace graze::oracle {
namespace {

using Polynomial = IntegerPolynomial;

/// A vector whose components are polynomials in time.
using MovingVector = std::array<Polynomial, 3>;

/// The least power of two that makes all coordinates whole.
Rational scale_of(const MovingPoints& points) {
  Rational scale = 1;
  for (const auto* const at : {&points.start, &points.end})
    for (const Eigen::Vector3d& point : *at)
      for (const double coordinate : point) scale = std::max<Rational>(scale, Rational(coordinate).get_den());
  return scale;
}

MovingVector vector_between(const MovingPoints& points, std::size_t from, std::size_t to) {
  const Rational scale = scale_of(points);
  const auto along = [&](const std::array<Eigen::Vector3d, 4>& at, std::size_t axis) -> mpz_class {
    const auto i = static_cast<Eigen::Index>(axis);
    const Rational length = scale * (Rational(at[to][i]) - Rational(at[from][i]));
    return length.get_num();
  };
  MovingVector result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const mpz_class start = along(points.start, axis);
    result[axis] = sum({start}, {0, along(points.end, axis) - start});
  }
  return result;
}

MovingVector added(const MovingVector& p, const MovingVector& q) {
  return {sum(p[0], q[0]), sum(p[1], q[1]), sum(p[2], q[2])};
}
Polynomial dot(const MovingVector& p, const MovingVector& q) {
  return sum(product(p[0], q[0]), sum(product(p[1], q[1]), product(p[2], q[2])));
}
MovingVector cross(const MovingVector& p, const MovingVector& q) {
  MovingVector result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result[i] = difference(product(p[j], q[k]), product(p[k], q[j]));
  }
  return result;
}

/// The features touch where the origin lies in one of these triangles. Their corners are differences of
/// points of one and of the other feature. Of two edges these fill a parallelogram, which its diagonal cuts.
struct Triangle {
  std::array<MovingVector, 3> corner;
  std::array<MovingVector, 3> turn;  ///< the cross product of a corner and the next one
  MovingVector normal;               ///< the sum of these

  explicit Triangle(const std::array<MovingVector, 3>& corners) : corner(corners) {
    for (std::size_t i = 0; i < 3; ++i) turn[i] = cross(corner[i], corner[(i + 1) % 3]);
    normal = added(added(turn[0], turn[1]), turn[2]);
  }

  /// Calls `visit` with each polynomial whose sign has_origin() asks for.
  template <typename Visit>
  void visit_polynomials(const Visit& visit) const {
    visit(dot(corner[0], turn[1]));
    for (std::size_t i = 0; i < 3; ++i) {
      visit(normal[i]);
      visit(dot(turn[i], normal));
      visit(dot(corner[i], corner[(i + 1) % 3]));
      for (std::size_t axis = 0; axis < 3; ++axis) visit(turn[i][axis]);
    }
  }

  /// Whether the origin lies in the triangle, by signs of polynomials: on a side, or in its plane and on the
  /// inner side of each side.
  template <typename SignOf>
  [[nodiscard]] bool has_origin(const SignOf& sign_of) const {
    const auto is_zero = [&](const MovingVector& v) {
      return sign_of(v[0]) == 0 && sign_of(v[1]) == 0 && sign_of(v[2]) == 0;
    };
    if (sign_of(dot(corner[0], turn[1])) != 0) return false;
    bool inside = !is_zero(normal);
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_zero(turn[i]) && sign_of(dot(corner[i], corner[(i + 1) % 3])) <= 0) return true;
      inside = inside && sign_of(dot(turn[i], normal)) >= 0;
    }
    return inside;
  }
};

std::vector<Triangle> triangles_of(const MovingPoints& points) {
  const auto way = [&](std::size_t from, std::size_t to) { return vector_between(points, from, to); };
  std::vector<Triangle> triangles;
  if (points.are_edges) {
    triangles.emplace_back(std::array<MovingVector, 3>{way(0, 2), way(0, 3), way(1, 3)});
    triangles.emplace_back(std::array<MovingVector, 3>{way(0, 2), way(1, 2), way(1, 3)});
  } else {
    triangles.emplace_back(std::array<MovingVector, 3>{way(0, 1), way(0, 2), way(0, 3)});
  }
  return triangles;
}

/// The times at which the answer may change. In space these are the times at which the points lie in a
/// plane. Where they always do, any of the signs may change it.
std::vector<AlgebraicTime> candidate_times(const std::vector<Triangle>& triangles) {
  const Polynomial volume = dot(triangles[0].corner[0], triangles[0].turn[1]);
  if (!volume.empty()) return roots_in_unit_interval(volume);
  std::vector<AlgebraicTime> times;
  for (const Triangle& triangle : triangles)
    triangle.visit_polynomials([&](const Polynomial& polynomial) {
      if (polynomial.empty()) return;
      for (const AlgebraicTime& time : roots_in_unit_interval(polynomial)) times.push_back(time);
    });
  return times;
}

/// Times that are closer than this count as one.
const Rational narrow_width = Rational(1, mpz_class(1) << 100);

Rational squared_length_to(const Point& corner, const Point& next) {
  const Point line = next - corner;
  const Rational length = squared_length(line);
  if (length == 0) return squared_length(corner);
  const Rational along = -dot(corner, line) / length;
  return squared_length(corner + std::clamp(along, Rational(0), Rational(1)) * line);
}

}  // namespace

std::optional<AlgebraicTime> first_meeting(const MovingPoints& points) {
  if (touch_at(points, 0)) return AlgebraicTime{{0, 1}, 0, 0};
  const std::vector<Triangle> triangles = triangles_of(points);
  std::optional<AlgebraicTime> first;
  for (AlgebraicTime& time : candidate_times(triangles)) {
    if (first && first->high <= time.low) continue;
    const auto sign_of = [&](const Polynomial& polynomial) { return time.sign_of(polynomial); };
    if (std::none_of(triangles.begin(), triangles.end(),
                     [&](const Triangle& triangle) { return triangle.has_origin(sign_of); }))
      continue;
    time.narrow(narrow_width);
    if (!first || time.low < first->low) first = time;
  }
  return first;
}

bool touch_at(const MovingPoints& points, const Rational& time) {
  const auto sign_of = [&](const Polynomial& polynomial) { return sign_at(polynomial, time); };
  for (const Triangle& triangle : triangles_of(points))
    if (triangle.has_origin(sign_of)) return true;
  return false;
}

Rational squared_distance_at(const MovingPoints& points, const Rational& time) {
  std::optional<Rational> least;
  for (const Triangle& triangle : triangles_of(points)) {
    const auto at = [&](const MovingVector& v) {
      return Point{value_at(v[0], time), value_at(v[1], time), value_at(v[2], time)};
    };
    const Point normal = at(triangle.normal);
    bool inside = !is_zero(normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const Rational side = squared_length_to(at(triangle.corner[i]), at(triangle.corner[(i + 1) % 3]));
      if (!least || side < *least) least = side;
      inside = inside && dot(at(triangle.turn[i]), normal) >= 0;
    }
    if (!inside) continue;
    const Rational height = dot(at(triangle.corner[0]), normal);
    least = std::min<Rational>(*least, height * height / squared_length(normal));
  }
  const Rational scale = scale_of(points);
  return *least / (scale * scale);
}

}  // namespace graze::oracle
