#include "support/oracle/integer_polynomial.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace graze::oracle {
namespace {

void trim(IntegerPolynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

/// Divides by the greatest common divisor of the coefficients.
IntegerPolynomial primitive(IntegerPolynomial p) {
  mpz_class divisor;
  for (const mpz_class& coefficient : p) divisor = gcd(divisor, coefficient);
  for (mpz_class& coefficient : p) coefficient /= divisor;
  return p;
}

/// The remainder of a multiple of p.
IntegerPolynomial remainder(IntegerPolynomial p, const IntegerPolynomial& q) {
  while (!p.empty() && p.size() >= q.size()) {
    const std::size_t shift = p.size() - q.size();
    const mpz_class top = p.back();
    for (mpz_class& coefficient : p) coefficient *= q.back();
    for (std::size_t i = 0; i < q.size(); ++i) p[i + shift] -= top * q[i];
    trim(p);
  }
  return p;
}

IntegerPolynomial greatest_common_divisor(IntegerPolynomial p, IntegerPolynomial q) {
  while (!q.empty()) {
    IntegerPolynomial rest = primitive(remainder(p, q));
    p = std::exchange(q, std::move(rest));
  }
  return primitive(p);
}

/// Divides by a primitive polynomial that leaves no remainder. By Gauss's lemma the quotient is whole.
IntegerPolynomial quotient(IntegerPolynomial p, const IntegerPolynomial& q) {
  IntegerPolynomial result(p.size() - q.size() + 1);
  for (std::size_t shift = result.size(); shift-- > 0;) {
    result[shift] = p[shift + q.size() - 1] / q.back();
    for (std::size_t i = 0; i < q.size(); ++i) p[i + shift] -= result[shift] * q[i];
  }
  return result;
}

IntegerPolynomial without_multiple_roots(const IntegerPolynomial& p) {
  IntegerPolynomial derivative;
  for (std::size_t i = 1; i < p.size(); ++i) derivative.push_back(p[i] * static_cast<unsigned long>(i));
  return quotient(primitive(p), greatest_common_divisor(p, derivative));
}

/// How often the signs of the Bernstein coefficients over [low, high] change. The polynomial of
/// low + (high − low) / (1 + s) has the same signs, in the powers of s.
int sign_changes(const IntegerPolynomial& p, const Rational& low, const Rational& high) {
  // The ends have one denominator d. So (1 + s)^n d^n p((high + low s) / (1 + s)) is whole: Horner's rule.
  const mpz_class d = lcm(low.get_den(), high.get_den());
  const Rational scaled_low = low * d;
  const Rational scaled_high = high * d;
  const IntegerPolynomial numerator = {scaled_high.get_num(), scaled_low.get_num()};
  const IntegerPolynomial denominator = {d, d};
  IntegerPolynomial q;
  IntegerPolynomial power = {1};
  for (std::size_t i = p.size(); i-- > 0;) {
    q = sum(product(q, numerator), product({p[i]}, power));
    power = product(power, denominator);
  }
  int changes = 0;
  int last = 0;
  for (const mpz_class& coefficient : q) {
    const int sign = sgn(coefficient);
    if (sign * last < 0) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

/// Adds the roots in ]low, high[.
void add_roots(const IntegerPolynomial& p, const Rational& low, const Rational& high,
               std::vector<AlgebraicTime>& roots) {
  const int changes = sign_changes(p, low, high);
  if (changes == 0) return;
  if (changes == 1 && sign_at(p, low) * sign_at(p, high) < 0) {
    roots.push_back({p, low, high});
    return;
  }
  const Rational middle = (low + high) / 2;
  add_roots(p, low, middle, roots);
  if (sign_at(p, middle) == 0) roots.push_back({p, middle, middle});
  add_roots(p, middle, high, roots);
}

}  // namespace

IntegerPolynomial sum(const IntegerPolynomial& p, const IntegerPolynomial& q) {
  IntegerPolynomial result(std::max(p.size(), q.size()));
  for (std::size_t i = 0; i < p.size(); ++i) result[i] += p[i];
  for (std::size_t i = 0; i < q.size(); ++i) result[i] += q[i];
  trim(result);
  return result;
}

IntegerPolynomial difference(const IntegerPolynomial& p, const IntegerPolynomial& q) {
  return sum(p, product({-1}, q));
}

IntegerPolynomial product(const IntegerPolynomial& p, const IntegerPolynomial& q) {
  if (p.empty() || q.empty()) return {};
  IntegerPolynomial result(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j) result[i + j] += p[i] * q[j];
  trim(result);
  return result;
}

Rational value_at(const IntegerPolynomial& p, const Rational& time) {
  Rational value;
  for (std::size_t i = p.size(); i-- > 0;) value = value * time + p[i];
  return value;
}

int sign_at(const IntegerPolynomial& p, const Rational& time) {
  mpz_class value;
  mpz_class power = 1;
  for (std::size_t i = p.size(); i-- > 0;) {
    value = value * time.get_num() + p[i] * power;
    power *= time.get_den();
  }
  return sgn(value);
}

void AlgebraicTime::halve() {
  const Rational middle = (low + high) / 2;
  const int sign = sign_at(polynomial, middle);
  if (sign == 0) {
    low = high = middle;
  } else {
    (sign == sign_at(polynomial, low) ? low : high) = middle;
  }
}

void AlgebraicTime::narrow(const Rational& width) {
  while (high - low > width) halve();
}

int AlgebraicTime::compare(const Rational& time) const {
  AlgebraicTime narrowed = *this;
  if (low < time && time < high && sign_at(polynomial, time) == 0) return 0;
  while (narrowed.low < time && time < narrowed.high) narrowed.halve();
  if (narrowed.low == narrowed.high) return sgn(Rational(narrowed.low - time));
  return narrowed.high <= time ? -1 : 1;
}

int AlgebraicTime::sign_of(const IntegerPolynomial& factor) const {
  if (low == high) return sign_at(factor, low);
  if (factor.empty()) return 0;
  AlgebraicTime narrowed = *this;
  for (int halvings = 0; narrowed.low != narrowed.high; ++halvings) {
    if (sign_changes(factor, narrowed.low, narrowed.high) == 0) break;
    if (halvings == 4) {
      const IntegerPolynomial common = greatest_common_divisor(polynomial, factor);
      if (sign_at(common, low) * sign_at(common, high) < 0) return 0;
    }
    narrowed.halve();
  }
  return sign_at(factor, Rational((narrowed.low + narrowed.high) / 2));
}

std::vector<AlgebraicTime> roots_in_unit_interval(const IntegerPolynomial& p) {
  const IntegerPolynomial simple = without_multiple_roots(p);
  std::vector<AlgebraicTime> roots;
  if (sign_at(simple, 0) == 0) roots.push_back({simple, 0, 0});
  add_roots(simple, 0, 1, roots);
  if (sign_at(simple, 1) == 0) roots.push_back({simple, 1, 1});
  return roots;
}

}  // namespace graze::oracle
