#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

#include "arithmetic/exact.hpp"

namespace graze {

/// A double and how far the true value is from it at most. Radii are rounded to nearest like everything else.
/// The factor in `sign` covers that for chains of up to 2^32 operations, each off by at most 2^-53 of the
/// radius. Overflow makes the radius infinite or NaN, which decides nothing.
struct Ball {
  double value = 0;
  double radius = 0;

  Ball() = default;
  Ball(double exact_value)
      : value(exact_value) {}  // NOLINT(google-explicit-constructor): a double is a point
  Ball(double middle, double half_width) : value(middle), radius(half_width) {}

  friend Ball operator+(const Ball& left, const Ball& right) {
    const double sum = left.value + right.value;
    return {sum, left.radius + right.radius + std::abs(sum) * half_ulp};
  }
  friend Ball operator-(const Ball& left, const Ball& right) {
    const double difference = left.value - right.value;
    return {difference, left.radius + right.radius + std::abs(difference) * half_ulp};
  }
  friend Ball operator*(const Ball& left, const Ball& right) {
    if (left.is_zero() || right.is_zero()) return {};
    const double product = left.value * right.value;
    return {product, std::abs(left.value) * right.radius +
                         left.radius * (std::abs(right.value) + right.radius) + std::abs(product) * half_ulp +
                         underflow};
  }
  Ball operator-() const { return {-value, radius}; }

  /// Whether the number is certainly zero, as the difference of two coordinates with equal bits is.
  [[nodiscard]] bool is_zero() const { return value == 0 && radius == 0; }

  static constexpr double half_ulp = 0x1p-53;
  static constexpr double underflow =
      0x1p-1070;  ///< more than four products can lose below the smallest denormal
  static constexpr double slack = 1 + 0x1p-20;  ///< for the rounding of the radii themselves
};

/// The sign of a number where it is certain. Otherwise `unsure` is set and the answer means nothing.
inline int sign(const Ball& number, bool& unsure) {
  if (std::abs(number.value) > number.radius * Ball::slack) return number.value > 0 ? 1 : -1;
  if (!number.is_zero()) unsure = true;
  return 0;
}
template <int limb_count>
int sign(const BasicExact<limb_count>& number, bool& /*unsure*/) {
  return number.sign();
}

/// How each stage decided. One per worker, so counting needs no atomics.
struct DecisionCount {
  std::uint64_t discarded_in_float = 0;  ///< pairs of features or vertices
  std::uint64_t named_in_float = 0;      ///< contacts, as often as they were found
  std::uint64_t in_double = 0;           ///< questions that Ball answered
  std::uint64_t exact = 0;               ///< questions and roundings that went on to Exact
};

/// Answers `question.operator()<Number>(bool& unsure)` in Ball arithmetic, and in Exact where that was
/// unsure.
template <typename Question>
auto decide(DecisionCount& count, const Question& question) {
  bool unsure = false;
  const auto answer = question.template operator()<Ball>(unsure);
  if (!unsure) {
    ++count.in_double;
    return answer;
  }
  ++count.exact;
  unsure = false;
  return question.template operator()<Exact>(unsure);
}

/// The sign of `number.operator()<Number>()`, decided as above. A question with several signs mostly is
/// unsure of one alone.
template <typename NumberOf>
int decide_sign(DecisionCount& count, const NumberOf& number) {
  return decide(count, [&]<typename Number>(bool& unsure) {
    return sign(number.template operator()<Number>(), unsure);
  });
}

/// A vector of three numbers of any of the arithmetics.
template <typename Number>
struct Vector {
  Number x, y, z;

  friend Vector operator+(const Vector& left, const Vector& right) {
    return {left.x + right.x, left.y + right.y, left.z + right.z};
  }
  friend Vector operator-(const Vector& left, const Vector& right) {
    return {left.x - right.x, left.y - right.y, left.z - right.z};
  }
  friend Vector operator*(const Vector& vector, const Number& factor) {
    return {vector.x * factor, vector.y * factor, vector.z * factor};
  }
};

template <typename Number>
Number dot(const Vector<Number>& left, const Vector<Number>& right) {
  return left.x * right.x + left.y * right.y + left.z * right.z;
}

template <typename Number>
Vector<Number> cross(const Vector<Number>& left, const Vector<Number>& right) {
  return {left.y * right.z - left.z * right.y, left.z * right.x - left.x * right.z,
          left.x * right.y - left.y * right.x};
}

/// to − from. All kernels see coordinates through this alone, so that a moved scene gives the same numbers.
template <typename Number>
Vector<Number> difference(const Eigen::Vector3d& to, const Eigen::Vector3d& from) {
  if constexpr (requires { Number::difference(to.x(), from.x()); }) {
    return {Number::difference(to.x(), from.x()), Number::difference(to.y(), from.y()),
            Number::difference(to.z(), from.z())};
  } else {
    return {Number(to.x()) - Number(from.x()), Number(to.y()) - Number(from.y()),
            Number(to.z()) - Number(from.z())};
  }
}

/// The normal of a triangle by its winding, as long as twice its area.
template <typename Number>
Vector<Number> normal_of_corners(const std::array<Eigen::Vector3d, 3>& corner) {
  return cross(difference<Number>(corner[1], corner[0]), difference<Number>(corner[2], corner[0]));
}

/// The component of a vector along an axis.
template <typename Number>
const Number& component(const Vector<Number>& vector, int axis) {
  return axis == 0 ? vector.x : (axis == 1 ? vector.y : vector.z);
}

/// Whether `vector.operator()<Number>()` is zero.
template <typename VectorOf>
bool is_zero(DecisionCount& count, const VectorOf& vector) {
  return decide(count, [&]<typename Number>(bool& unsure) {
    const Vector<Number> asked = vector.template operator()<Number>();
    bool any_unsure = false;
    for (const Number* const part : {&asked.x, &asked.y, &asked.z})
      if (sign(*part, any_unsure) != 0) return false;
    unsure = any_unsure;
    return true;
  });
}

/// numerator / denominator with a positive denominator.
template <typename Number>
struct Ratio {
  Number numerator;
  Number denominator;
};

/// -1, 0 or 1 as left is less than, equal to or greater than right.
template <typename Number>
int compare(const Ratio<Number>& left, const Ratio<Number>& right, bool& unsure) {
  return sign(left.numerator * right.denominator - right.numerator * left.denominator, unsure);
}

}  // namespace graze
