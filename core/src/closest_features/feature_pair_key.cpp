#include "closest_features/feature_pair_key.hpp"

#include <cmath>
#include <limits>

#include "arithmetic/certain.hpp"
#include "arithmetic/wide.hpp"
#include "closest_features/ratio.hpp"

namespace graze {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <typename Number>
Ratio<Number> squared(const SurfacePair& pair, const FeaturePairKey& key) {
  if (key.meeting() == Meeting::pierced) return {Number(0.0), Number(1.0)};
  const Hulls hulls = hulls_of(pair, key);
  return hull_distance_squared<Number>(hulls.a, hulls.b);
}

/// The square root of a quotient, to a relative error of a few 2^-53, whatever its exponent.
double approximate_root(const Ratio<Exact>& square) {
  const Exact::Scaled top = square.numerator.scaled();
  const Exact::Scaled bottom = square.denominator.scaled();
  double fraction = top.fraction / bottom.fraction;
  int exponent = top.exponent - bottom.exponent;
  if (exponent % 2 != 0) {
    fraction *= 2;
    --exponent;
  }
  return std::ldexp(std::sqrt(fraction), exponent / 2);
}

/// The square root of a quotient. Where double is too narrow for it, not a number, so that nothing is
/// certain.
double approximate_root(const Ratio<Wide>& square) {
  const double quotient = square.numerator.high / square.denominator.high;
  return quotient > 0x1p-900 && quotient < 0x1p900 ? std::sqrt(quotient) : not_a_number;
}

/// The sign of value² − square.
template <typename Number>
int compare_square(double value, const Ratio<Number>& square, bool& unsure) {
  const Number number(value);
  return sign(number * number * square.denominator - square.numerator, unsure);
}

/// The root of a quotient rounded down and up. Means nothing, but ends, where it becomes unsure.
template <typename Number>
DistanceBounds rounded_root(const Ratio<Number>& square, bool& unsure) {
  if (sign(square.numerator, unsure) == 0) return {0, 0};
  DistanceBounds bounds;
  bounds.lower = approximate_root(square);
  while (compare_square(bounds.lower, square, unsure) > 0) bounds.lower = std::nextafter(bounds.lower, 0);
  bounds.upper = bounds.lower;
  while (compare_square(bounds.upper, square, unsure) < 0) {
    bounds.lower = bounds.upper;
    bounds.upper = std::nextafter(bounds.upper, infinity);
  }
  if (compare_square(bounds.upper, square, unsure) == 0) bounds.lower = bounds.upper;
  return bounds;
}

}  // namespace

Hulls hulls_of(const SurfacePair& pair, const FeaturePairKey& key) {
  Hulls hulls{simplex_of(pair.a, key.a()), simplex_of(pair.b, key.b())};
  if (key.meeting() == Meeting::parallel) (hulls.a.size <= hulls.b.size ? hulls.a : hulls.b).size = 1;
  return hulls;
}

bool do_touch(const Hulls& hulls, DecisionCount& count) {
  const Simplex& low = hulls.a.size <= hulls.b.size ? hulls.a : hulls.b;
  const Simplex& high = hulls.a.size <= hulls.b.size ? hulls.b : hulls.a;
  if (high.size == 1) return low.point[0] == high.point[0];
  const auto offset = [&]<typename Number>() { return difference<Number>(low.point[0], high.point[0]); };
  const auto along = [&]<typename Number>() { return difference<Number>(high.point[1], high.point[0]); };
  if (high.size == 2 && low.size == 1)
    return is_zero(count, [&]<typename Number>() {
      return cross(along.template operator()<Number>(), offset.template operator()<Number>());
    });
  const int side = decide_sign(count, [&]<typename Number>() {
    const Vector<Number> other = high.size == 3 ? difference<Number>(high.point[2], high.point[0])
                                                : difference<Number>(low.point[1], low.point[0]);
    return dot(cross(along.template operator()<Number>(), other), offset.template operator()<Number>());
  });
  return side == 0;
}

int compare_distances(const SurfacePair& pair, const FeaturePairKey& left, const FeaturePairKey& right) {
  if (left.meeting() == Meeting::pierced && right.meeting() == Meeting::pierced) return 0;
  return decide(pair.count, [&]<typename Number>(bool& unsure) {
    return compare(squared<Number>(pair, left), squared<Number>(pair, right), unsure);
  });
}

bool decide_closer_than(const SurfacePair& pair, const FeaturePairKey& key, double limit) {
  if (key.meeting() == Meeting::pierced || limit == 0 || std::isinf(limit)) return limit > 0;
  return decide(pair.count, [&]<typename Number>(bool& unsure) {
    const Ratio<Number> square = squared<Number>(pair, key);
    return sign(Number(limit) * Number(limit) * square.denominator - square.numerator, unsure) > 0;
  });
}

double upper_distance(const SurfacePair& pair, const FeaturePairKey& key) {
  const Ratio<Ball> square = squared<Ball>(pair, key);
  // Only radii need the slack of balls: a distance that is 2^-20 too large would be no bound from below.
  const double top = (square.numerator.value + square.numerator.radius * Ball::slack) * round_up;
  const double bottom = (square.denominator.value - square.denominator.radius * Ball::slack) * round_down;
  const bool is_tight = square.numerator.radius <= square.numerator.value * 0x1p-42 &&
                        square.denominator.radius <= square.denominator.value * 0x1p-42;
  if (is_tight && std::isfinite(top) && bottom > 0) {
    const double root = std::sqrt(top / bottom);
    if (root > 0x1p-500 && std::isfinite(root)) return root * round_up;
  }
  return rounded_distance(pair, key).upper;
}

DistanceBounds rounded_distance(const SurfacePair& pair, const FeaturePairKey& key) {
  bool unsure = false;
  const DistanceBounds bounds = rounded_root(squared<Wide>(pair, key), unsure);
  if (!unsure) return bounds;
  ++pair.count.exact;
  return rounded_root(squared<Exact>(pair, key), unsure);
}

}  // namespace graze
