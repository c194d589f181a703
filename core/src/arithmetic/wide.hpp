#pragma once

#include <cmath>
#include <optional>

#include "arithmetic/arithmetic.hpp"

namespace graze {

/// A sum of two doubles (low is what rounding to high left over) and how far the true value is from it at
/// most: what Ball is to double. For the few questions that Ball leaves and the many numbers of them that
/// Exact would take long for.
struct Wide {
  double high = 0;
  double low = 0;
  double radius = 0;

  Wide() = default;
  Wide(double exact_value) : high(exact_value) {}  // NOLINT(google-explicit-constructor): a double is a point
  Wide(double upper, double lower, double half_width) : high(upper), low(lower), radius(half_width) {}

  friend Wide operator+(const Wide& left, const Wide& right) {
    const Wide highs = sum_of(left.high, right.high);
    const double lows = left.low + right.low;
    const double rest = highs.low + lows;
    Wide sum = sum_of(highs.high, rest);
    sum.radius = left.radius + right.radius + (std::abs(lows) + std::abs(rest)) * ulp;
    return sum;
  }
  friend Wide operator-(const Wide& left, const Wide& right) { return left + -right; }
  friend Wide operator*(const Wide& left, const Wide& right) {
    if (left.is_zero() || right.is_zero()) return {};
    const Wide highs = product_of(left.high, right.high);
    Wide product = sum_of(highs.high, highs.low + (left.high * right.low + left.low * right.high));
    product.radius = std::abs(left.high) * right.radius +
                     left.radius * (std::abs(right.high) + right.radius) +
                     std::abs(product.high) * off_product + underflow;
    return product;
  }
  Wide operator-() const { return {-high, -low, radius}; }

  [[nodiscard]] bool is_zero() const { return high == 0 && radius == 0; }
  /// How far the truth is from high + low at most, with all that the radius itself lost.
  [[nodiscard]] double off() const { return radius * slack; }

  /// The sum of two doubles.
  static Wide sum_of(double left, double right) {
    const double sum = left + right;
    const double of_right = sum - left;
    return {sum, (left - (sum - of_right)) + (right - of_right), 0};
  }
  /// The product of two doubles, but for what is below `underflow` (Dekker: halves of 26 bits).
  static Wide product_of(double left, double right) {
    const double product = left * right;
    const double left_high = upper_half(left);
    const double right_high = upper_half(right);
    const double left_low = left - left_high;
    const double right_low = right - right_high;
    const double rest = ((left_high * right_high - product) + left_high * right_low + left_low * right_high) +
                        left_low * right_low;
    return {product, rest, 0};
  }

  static constexpr double ulp = 0x1p-52;
  static constexpr double off_product = 0x1.4p-103;  ///< 10 · 2^-106, see docs/numerics.md
  static constexpr double underflow = 0x1p-1000;
  static constexpr double slack = Ball::slack;

 private:
  static double upper_half(double number) {
    const double shifted = number * (0x1p27 + 1);
    return shifted - (shifted - number);
  }
};

inline int sign(const Wide& number, bool& unsure) {
  if (std::abs(number.high) * (1 - 0x1p-50) > number.off()) return number.high > 0 ? 1 : -1;
  if (!number.is_zero()) unsure = true;
  return 0;
}

/// `Exact::quotient(base · denominator + numerator, denominator)`, where the balls leave no doubt of it.
std::optional<double> rounded_quotient(double base, const Wide& numerator, const Wide& denominator);

/// Returns `Exact::scaled` of the true value, if the ball leaves no doubt of it.
std::optional<Exact::Scaled> scaled(const Wide& number);

}  // namespace graze
