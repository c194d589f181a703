#include "support/exact/exact_winding.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "support/random/random_scenes.hpp"

namespace graze::oracle {

namespace {

/// Coordinates below this many units give products that fit in 64 bits.
constexpr double small_limit = 0x1p12;
constexpr std::uint32_t direction_count = 1000;  ///< in each coordinate

template <typename Integer>
struct Vector {
  Integer x, y, z;
};
template <typename Integer>
using Triangle3 = std::array<Vector<Integer>, 3>;

template <typename Integer>
int sign_of(const Integer& value) {
  return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0);
}
template <typename Integer>
Vector<Integer> cross(const Vector<Integer>& p, const Vector<Integer>& q) {
  return {Integer(p.y * q.z - p.z * q.y), Integer(p.z * q.x - p.x * q.z), Integer(p.x * q.y - p.y * q.x)};
}
template <typename Integer>
Integer dot(const Vector<Integer>& p, const Vector<Integer>& q) {
  return Integer(p.x * q.x + p.y * q.y + p.z * q.z);
}
template <typename Integer>
bool is_zero(const Vector<Integer>& p) {
  return p.x == 0 && p.y == 0 && p.z == 0;
}

/// What a triangle looks like from the origin, without a direction.
template <typename Integer>
struct Seen {
  std::array<Vector<Integer>, 3> planes;  ///< normals of the planes through the origin and each side
  Vector<Integer> normal;                 ///< their sum: that of the triangle, by its winding
  int height_sign = 0;  ///< of normal · corner. With 0 the origin is in the triangle's plane
};

template <typename Integer>
Seen<Integer> look_at(const Triangle3<Integer>& triangle) {
  Seen<Integer> seen;
  for (std::size_t i = 0; i < 3; ++i) seen.planes[i] = cross(triangle[i], triangle[(i + 1) % 3]);
  const auto& [p, q, r] = seen.planes;
  seen.normal = {Integer(p.x + q.x + r.x), Integer(p.y + q.y + r.y), Integer(p.z + q.z + r.z)};
  seen.height_sign = sign_of(dot(triangle[0], seen.planes[1]));
  return seen;
}

/// Whether the origin lies on a triangle, borders included. One without area is its three sides.
template <typename Integer>
bool holds_origin(const Triangle3<Integer>& triangle, const Seen<Integer>& seen) {
  if (seen.height_sign != 0) return false;
  bool is_within = !is_zero(seen.normal);
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_zero(seen.planes[i]) && dot(triangle[i], triangle[(i + 1) % 3]) <= 0) return true;
    is_within = is_within && dot(seen.planes[i], seen.normal) > 0;
  }
  return is_within;
}

/// How a ray from the origin passes a triangle on which the origin is not: 1 along the normal, -1 against it,
/// 0 past it. None where the ray's line is in the plane of the triangle or meets the line of a side.
template <typename Integer>
std::optional<int> passing(const Seen<Integer>& seen, const Vector<Integer>& direction) {
  if (is_zero(seen.normal)) return 0;
  const int along_normal = sign_of(dot(seen.normal, direction));
  if (along_normal == 0) return std::nullopt;
  if (seen.height_sign == 0) return 0;
  std::array<int, 3> signs{};
  for (std::size_t i = 0; i < 3; ++i) {
    signs[i] = sign_of(dot(seen.planes[i], direction));
    if (signs[i] == 0) return std::nullopt;
  }
  const bool is_hit = signs[0] == signs[1] && signs[1] == signs[2] && along_normal == seen.height_sign;
  return is_hit ? along_normal : 0;
}

template <typename Integer>
Vector<Integer> random_direction(Random& random) {
  const auto coordinate = [&random] {
    return Integer(static_cast<long>(random.below(direction_count)) - static_cast<long>(direction_count / 2));
  };
  Vector<Integer> direction;
  direction.x = coordinate();
  direction.y = coordinate();
  direction.z = coordinate();
  return direction;
}

/// The winding number about the origin. None if the direction is no good.
template <typename Integer>
std::optional<int> count(const std::vector<Seen<Integer>>& all, const Vector<Integer>& direction) {
  int number = 0;
  for (const Seen<Integer>& seen : all) {
    const std::optional<int> passed = passing(seen, direction);
    if (!passed) return std::nullopt;
    number += *passed;
  }
  return number;
}

template <typename Integer>
Winding winding_about_origin(const std::vector<Triangle3<Integer>>& triangles) {
  std::vector<Seen<Integer>> all;
  all.reserve(triangles.size());
  for (const Triangle3<Integer>& triangle : triangles) {
    all.push_back(look_at(triangle));
    if (holds_origin(triangle, all.back())) return {0, true};
  }
  Random random(triangles.size());
  while (true)
    if (const auto number = count(all, random_direction<Integer>(random))) return {*number, false};
}

/// The exponent of the last bit of a number that is 1.
int last_bit_of(double value) {
  if (value == 0) return std::numeric_limits<int>::max();
  int exponent = 0;
  const auto whole = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(value), &exponent), 53));
  return exponent - 53 + std::countr_zero(whole);
}

int last_bit_of(const Eigen::Vector3d& point) {
  return std::min({last_bit_of(point.x()), last_bit_of(point.y()), last_bit_of(point.z())});
}

/// `value` in units of two to the power `unit`, of which it is a multiple.
mpz_class in_units(double value, int unit) {
  if (value == 0) return 0;
  int exponent = 0;
  mpz_class whole(std::ldexp(std::frexp(value, &exponent), 53));
  const int shift = exponent - 53 - unit;
  return shift >= 0 ? mpz_class(whole << static_cast<unsigned>(shift))
                    : mpz_class(whole >> static_cast<unsigned>(-shift));
}

Vector<mpz_class> in_units(const Eigen::Vector3d& point, int unit) {
  return {in_units(point.x(), unit), in_units(point.y(), unit), in_units(point.z(), unit)};
}

Vector<std::int64_t> in_few_units(const Eigen::Vector3d& point, int unit) {
  const auto coordinate = [unit](double value) {
    return static_cast<std::int64_t>(std::ldexp(value, -unit));
  };
  return {coordinate(point.x()), coordinate(point.y()), coordinate(point.z())};
}

/// The triangles moved so that the point is the origin.
template <typename Integer, typename Triangles, typename Convert>
std::vector<Triangle3<Integer>> seen_from(const Eigen::Vector3d& point, const Triangles& triangles,
                                          const Convert& convert) {
  const Vector<Integer> origin = convert(point);
  std::vector<Triangle3<Integer>> result;
  result.reserve(triangles.size());
  for (const auto& triangle : triangles) {
    Triangle3<Integer> moved;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector<Integer> corner = convert(triangle[i]);
      moved[i] = {Integer(corner.x - origin.x), Integer(corner.y - origin.y), Integer(corner.z - origin.z)};
    }
    result.push_back(std::move(moved));
  }
  return result;
}

}  // namespace

WindingOracle::WindingOracle(const Shape& closed) : unit_(std::numeric_limits<int>::max()) {
  low_.setConstant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  const auto corner = [&](std::uint32_t vertex) -> const Eigen::Vector3d& {
    const Eigen::Vector3d& point = closed.positions[vertex];
    low_ = low_.cwiseMin(point);
    high_ = high_.cwiseMax(point);
    unit_ = std::min(unit_, last_bit_of(point));
    return point;
  };
  for (const auto& face : closed.faces)
    for (std::size_t i = 2; i < face.size(); ++i)
      triangles_.push_back({corner(face[0]), corner(face[i - 1]), corner(face[i])});
}

bool WindingOracle::is_outside_box(const Eigen::Vector3d& point) const {
  return (point.array() < low_.array()).any() || (point.array() > high_.array()).any();
}

Winding WindingOracle::about(const Eigen::Vector3d& point) const {
  if (is_outside_box(point)) return {0, false};
  const int unit = std::min(unit_, last_bit_of(point));
  const double largest = std::max(low_.cwiseAbs().maxCoeff(), high_.cwiseAbs().maxCoeff());
  if (std::ldexp(largest, -unit) >= small_limit) return about_in_any_length(point);
  return winding_about_origin(seen_from<std::int64_t>(
      point, triangles_, [unit](const Eigen::Vector3d& corner) { return in_few_units(corner, unit); }));
}

Winding WindingOracle::about_in_any_length(const Eigen::Vector3d& point) const {
  const int unit = std::min(unit_, last_bit_of(point));
  return winding_about_origin(seen_from<mpz_class>(
      point, triangles_, [unit](const Eigen::Vector3d& corner) { return in_units(corner, unit); }));
}

Winding winding(const Shape& closed, const Eigen::Vector3d& point) {
  return WindingOracle(closed).about(point);
}

}  // namespace graze::oracle
