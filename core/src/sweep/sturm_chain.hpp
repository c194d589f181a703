#pragma once

#include <array>
#include <cstddef>

#include "sweep/polynomial.hpp"

namespace graze {

/// The signed remainder sequence of a polynomial and another one of lower degree (docs/numerics.md). It
/// counts roots of the first one, by the sign of a third one at each.
template <typename Number>
class SturmChain {
 public:
  /// Counts the distinct roots of `polynomial`, of degree 1 to 3.
  explicit SturmChain(const Polynomial<Number>& polynomial)
      : SturmChain(polynomial, polynomial.derivative()) {}

  /// Counts the distinct roots of `polynomial` where `factor` is positive, less those where it is negative.
  static SturmChain weighted(const Polynomial<Number>& polynomial, const Polynomial<Number>& factor) {
    Polynomial<Number> second = polynomial.derivative() * factor;
    second.reduce(polynomial);
    return SturmChain(polynomial, second);
  }

  /// The sign of the first polynomial, and how often the signs of the sequence change.
  struct Signs {
    int first = 0;
    int changes = 0;
  };
  [[nodiscard]] Signs signs_at(const Number& time) const {
    Signs result;
    result.first = terms_[0].value_at(time).sign();
    int last = result.first;
    for (int i = 1; i < size_; ++i) {
      const int sign = terms_[static_cast<std::size_t>(i)].value_at(time).sign();
      if (sign * last < 0) ++result.changes;
      if (sign != 0) last = sign;
    }
    return result;
  }

 private:
  SturmChain(const Polynomial<Number>& first, const Polynomial<Number>& second) {
    terms_[0] = first;
    terms_[1] = second;
    if (second.is_zero()) return;
    size_ = 2;
    while (term(size_ - 1).degree() > 0) {
      term(size_) = term(size_ - 2);
      term(size_).reduce(term(size_ - 1));
      if (term(size_).is_zero()) return;
      term(size_).negate();
      ++size_;
    }
  }

  Polynomial<Number>& term(int index) { return terms_[static_cast<std::size_t>(index)]; }

  std::array<Polynomial<Number>, 4> terms_;  ///< of degree 3, 2, 1 and 0 at most
  int size_ = 1;
};

}  // namespace graze
