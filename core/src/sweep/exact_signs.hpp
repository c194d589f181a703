#pragma once

#include "sweep/sturm_chain.hpp"
#include "sweep/swept_polynomials.hpp"

namespace graze {

/// A time that is a number.
template <typename Number>
struct TimeAsNumber {
  Number time;

  [[nodiscard]] int sign(const Polynomial<Number>& polynomial) const {
    return polynomial.value_at(time).sign();
  }
};

/// A time that is the one root of a polynomial between two numbers, which are no roots of it.
template <typename Number>
struct TimeAsRoot {
  const Polynomial<Number>* polynomial;
  const Number* low;
  const Number* high;

  /// Tarski's count over one root is the sign there.
  [[nodiscard]] int sign(const Polynomial<Number>& factor) const {
    if (factor.is_zero()) return 0;
    const auto chain = SturmChain<Number>::weighted(*polynomial, factor);
    return chain.signs_at(*low).changes - chain.signs_at(*high).changes;
  }
};

/// The signs that feature_signs.hpp asks for, at an exact time. `near` is a ball that holds the time. Where
/// double arithmetic is certain of a sign all over the ball, no exact number is made.
template <typename Number, typename Time>
class ExactSigns {
 public:
  ExactSigns(const SweptPolynomials<Number>& polynomials, const Time& time, const Ball& near)
      : polynomials_(&polynomials), time_(&time), near_(near) {}

  [[nodiscard]] int cross(Edge first, Edge second, int axis) const {
    const Vector<Ball> product = graze::cross(vector(first), vector(second));
    bool unsure = false;
    const int rough = graze::sign(component(product, axis), unsure);
    return unsure ? time_->sign(polynomials_->cross(first, second, axis)) : rough;
  }
  [[nodiscard]] int dot(Edge first, Edge second) const {
    bool unsure = false;
    const int rough = graze::sign(graze::dot(vector(first), vector(second)), unsure);
    return unsure ? time_->sign(polynomials_->dot(first, second)) : rough;
  }

 private:
  [[nodiscard]] Vector<Ball> vector(Edge edge) const {
    return SweptVector<Ball>(polynomials_->sweep(), edge).at(near_);
  }

  const SweptPolynomials<Number>* polynomials_;
  const Time* time_;
  Ball near_;
};

}  // namespace graze
