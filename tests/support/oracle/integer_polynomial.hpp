#pragma once

#include <gmpxx.h>

#include <vector>

#include "support/exact/exact.hpp"

namespace graze::oracle {

/// A polynomial with whole coefficients, lowest power first, without zeros at the end. Zero is empty.
using IntegerPolynomial = std::vector<mpz_class>;

IntegerPolynomial sum(const IntegerPolynomial& p, const IntegerPolynomial& q);
IntegerPolynomial difference(const IntegerPolynomial& p, const IntegerPolynomial& q);
IntegerPolynomial product(const IntegerPolynomial& p, const IntegerPolynomial& q);
Rational value_at(const IntegerPolynomial& p, const Rational& time);
int sign_at(const IntegerPolynomial& p, const Rational& time);

/// A root of a polynomial without multiple roots: the only one in [low, high]. Either low = high, or neither
/// end is a root.
struct AlgebraicTime {
  IntegerPolynomial polynomial;
  Rational low, high;

  /// -1, 0 or 1 as the time is less than, equal to or greater than `time`.
  [[nodiscard]] int compare(const Rational& time) const;
  /// The sign of a polynomial at this time.
  [[nodiscard]] int sign_of(const IntegerPolynomial& factor) const;
  /// Halves the interval until it is at most this wide.
  void narrow(const Rational& width);

 private:
  void halve();
};

/// The distinct roots in [0, 1], ascending, of a polynomial that is not zero: by Descartes' rule of signs in
/// the Bernstein basis, after multiple roots were divided out.
std::vector<AlgebraicTime> roots_in_unit_interval(const IntegerPolynomial& p);

}  // namespace graze::oracle
