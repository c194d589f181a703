#pragma once

#include <gmpxx.h>

#include <Eigen/Core>

namespace graze::oracle {

using Rational = mpq_class;

/// A point or vector of exact coordinates.
struct Point {
  Rational x, y, z;
};

inline Point operator+(const Point& p, const Point& q) {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}
inline Point operator-(const Point& p, const Point& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}
inline Point operator*(const Rational& s, const Point& p) {
  return {s * p.x, s * p.y, s * p.z};
}
inline Rational dot(const Point& p, const Point& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
inline Rational squared_length(const Point& p) {
  return dot(p, p);
}
inline Point cross(const Point& p, const Point& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
inline bool is_zero(const Point& p) {
  return p.x == 0 && p.y == 0 && p.z == 0;
}

/// Converts a point to rational coordinates, without error: every double is a rational. The coordinates must
/// be finite.
inline Point exact(const Eigen::Vector3d& p) {
  return {Rational(p.x()), Rational(p.y()), Rational(p.z())};
}

enum class Rounding { down, nearest, up };

/// The double next to `value` in the direction given. Nearest breaks ties to even. Subnormals included.
double round(const Rational& value, Rounding rounding = Rounding::nearest);
Eigen::Vector3d round(const Point& point);

/// The double next to the square root of `squared`, which must not be negative.
double round_sqrt(const Rational& squared, Rounding rounding = Rounding::nearest);

}  // namespace graze::oracle
