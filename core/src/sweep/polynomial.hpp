#pragma once

#include <array>
#include <cstddef>

namespace graze {

/// A polynomial in time of degree 4 at most, with exact coefficients. It knows its degree.
template <typename Number>
class Polynomial {
 public:
  static constexpr int max_degree = 4;

  Polynomial() = default;
  /// Takes over any number of coefficients up to five, that of the lowest power first.
  template <typename... Numbers>
  explicit Polynomial(const Number& first, const Numbers&... others)
      : coefficients_{first, others...}, degree_(sizeof...(others)) {
    trim();
  }

  /// -1 for the polynomial that is zero everywhere.
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] bool is_zero() const { return degree_ < 0; }
  [[nodiscard]] const Number& operator[](int power) const {
    return coefficients_[static_cast<std::size_t>(power)];
  }

  [[nodiscard]] Number value_at(const Number& time) const {
    Number value;
    for (int power = degree_; power >= 0; --power) value = value * time + (*this)[power];
    return value;
  }

  friend Polynomial operator+(const Polynomial& left, const Polynomial& right) {
    return left.combined(right, [](const Number& a, const Number& b) { return a + b; });
  }
  friend Polynomial operator-(const Polynomial& left, const Polynomial& right) {
    return left.combined(right, [](const Number& a, const Number& b) { return a - b; });
  }
  friend Polynomial operator*(const Polynomial& left, const Polynomial& right) {
    Polynomial product;
    if (left.is_zero() || right.is_zero()) return product;
    product.degree_ = left.degree_ + right.degree_;
    for (int i = 0; i <= left.degree_; ++i)
      for (int j = 0; j <= right.degree_; ++j) product.at(i + j) = product[i + j] + left[i] * right[j];
    return product;
  }

  [[nodiscard]] Polynomial derivative() const {
    Polynomial result;
    for (int power = 1; power <= degree_; ++power)
      result.at(power - 1) = (*this)[power] * Number(static_cast<double>(power));
    result.degree_ = degree_ > 0 ? degree_ - 1 : -1;
    return result;
  }

  /// Subtracts a multiple of `divisor` from a positive multiple of this polynomial, so that the degree falls
  /// below that of `divisor`.
  void reduce(const Polynomial& divisor) {
    const Number& top = divisor[divisor.degree_];
    const Number factor = top.sign() > 0 ? top : -top;
    while (degree_ >= divisor.degree_) {
      const int shift = degree_ - divisor.degree_;
      const Number quotient = top.sign() > 0 ? (*this)[degree_] : -(*this)[degree_];
      for (int power = 0; power < degree_; ++power) {
        at(power) = (*this)[power] * factor;
        if (power >= shift) at(power) = (*this)[power] - quotient * divisor[power - shift];
      }
      --degree_;
      trim();
    }
  }

  void negate() {
    for (int power = 0; power <= degree_; ++power) at(power) = -(*this)[power];
  }

  /// Divides by the time as often as that leaves no remainder.
  void remove_root_at_zero() {
    while (degree_ >= 0 && (*this)[0].sign() == 0) {
      for (int power = 0; power < degree_; ++power) at(power) = (*this)[power + 1];
      --degree_;
    }
  }

  /// Divides by time − 1 as often as that leaves no remainder. Returns whether it did.
  bool remove_root_at_one() {
    bool removed = false;
    while (degree_ > 0) {
      Polynomial sums = *this;  // of the coefficients from each power on
      for (int power = degree_ - 1; power >= 0; --power) sums.at(power) = sums[power] + sums[power + 1];
      if (sums[0].sign() != 0) break;
      for (int power = 0; power < degree_; ++power) at(power) = sums[power + 1];
      --degree_;
      removed = true;
    }
    return removed;
  }

 private:
  Number& at(int power) { return coefficients_[static_cast<std::size_t>(power)]; }

  template <typename Operation>
  [[nodiscard]] Polynomial combined(const Polynomial& other, const Operation& operation) const {
    Polynomial result;
    result.degree_ = degree_ > other.degree_ ? degree_ : other.degree_;
    const Number zero;
    for (int power = 0; power <= result.degree_; ++power)
      result.at(power) =
          operation(power <= degree_ ? (*this)[power] : zero, power <= other.degree_ ? other[power] : zero);
    result.trim();
    return result;
  }

  void trim() {
    while (degree_ >= 0 && (*this)[degree_].sign() == 0) --degree_;
  }

  std::array<Number, max_degree + 1> coefficients_{};  ///< only those up to the degree count
  int degree_ = -1;
};

}  // namespace graze
