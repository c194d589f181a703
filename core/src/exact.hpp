#pragma once

#include <array>
#include <cstdint>

namespace graze {

/// A dyadic rational without rounding: sign · magnitude · 2^(32 · exponent). Sums and products are exact;
/// there is no division. Lives wholly on the stack and allocates nothing, so that a decision in exact
/// arithmetic costs time only.
///
/// The capacity is enough for products of ten coordinate differences, the highest degree the kernels compare,
/// with coordinates from the smallest denormal, 2^-1074, to 2^121: (1195 + 4) · 10 bits < 32 · 384.
class Exact {
 public:
  Exact() {}  // NOLINT(modernize-use-equals-default): a defaulted one would zero the limbs in `Exact{}`
  Exact(const Exact& other) { copy(other); }
  Exact& operator=(const Exact& other) {
    if (this != &other) copy(other);
    return *this;
  }
  ~Exact() = default;
  Exact(double value);  // NOLINT(google-explicit-constructor): every finite double is one

  friend Exact operator+(const Exact& left, const Exact& right) { return add(left, right, right.sign_); }
  friend Exact operator-(const Exact& left, const Exact& right) { return add(left, right, -right.sign_); }
  friend Exact operator*(const Exact& left, const Exact& right);
  Exact operator-() const;

  /// -1, 0 or 1.
  [[nodiscard]] int sign() const { return sign_; }

  /// The value as fraction · 2^exponent with 0.5 ≤ |fraction| < 1 (0 for zero); relative error at most 2^-52.
  struct Scaled {
    double fraction = 0;
    int exponent = 0;
  };
  [[nodiscard]] Scaled scaled() const;

  /// left / right rounded to nearest, but for ties closer than 2^-100 of it.
  [[nodiscard]] static double quotient(const Exact& left, const Exact& right);

 private:
  static constexpr int capacity = 384;

  /// left / right to a relative error of at most 2^-50, unless it underflows.
  static double rough_quotient(const Exact& left, const Exact& right);
  static Exact add(const Exact& left, const Exact& right, int right_sign);
  static Exact add_magnitudes(const Exact& left, const Exact& right, int sign);
  static Exact subtract_magnitudes(const Exact& left, const Exact& right, int sign);
  static int compare_magnitudes(const Exact& left, const Exact& right);
  void trim();
  [[nodiscard]] std::uint32_t limb_at(int position) const {
    const int index = position - exponent_;
    return index >= 0 && index < size_ ? limbs_[static_cast<std::size_t>(index)] : 0;
  }

  void copy(const Exact& other);

  int sign_ = 0;
  int exponent_ = 0;                           ///< of the lowest limb, in limbs
  int size_ = 0;                               ///< limbs in use; neither the lowest nor the highest is 0
  std::array<std::uint32_t, capacity> limbs_;  ///< lowest first; only the first size_ are ever read
};

}  // namespace graze
