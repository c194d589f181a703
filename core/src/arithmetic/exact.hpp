#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace graze {

/// A dyadic rational without rounding: sign · magnitude · 2^(64 · exponent). Sums and products are exact.
/// There is no division. It lives wholly on the stack and allocates nothing, so that a decision in exact
/// arithmetic costs time only.
///
/// `limb_count` limbs of 64 bits have to be enough for every number that the caller makes, which an assertion
/// checks. Numbers in use have a few limbs, and copies take no more than these.
template <int limb_count>
class BasicExact {
 public:
  BasicExact() {}  // NOLINT(modernize-use-equals-default): a defaulted one would zero the limbs
  BasicExact(const BasicExact& other) { copy(other); }
  BasicExact& operator=(const BasicExact& other) {
    if (this != &other) copy(other);
    return *this;
  }
  ~BasicExact() = default;
  BasicExact(double value);  // NOLINT(google-explicit-constructor): every finite double is one
  /// to − from, which mostly is a double.
  static BasicExact difference(double to, double from);

  friend BasicExact operator+(const BasicExact& left, const BasicExact& right) {
    return add(left, right, right.sign_);
  }
  friend BasicExact operator-(const BasicExact& left, const BasicExact& right) {
    return add(left, right, -right.sign_);
  }
  friend BasicExact operator*(const BasicExact& left, const BasicExact& right) {
    return product(left, right);
  }
  BasicExact operator-() const;

  /// -1, 0 or 1.
  [[nodiscard]] int sign() const { return sign_; }

  /// The value as fraction · 2^exponent with 0.5 ≤ |fraction| < 1 (0 for zero). The relative error is at most
  /// 2^-52.
  struct Scaled {
    double fraction = 0;
    int exponent = 0;
  };
  [[nodiscard]] Scaled scaled() const;

  /// left / right rounded to nearest, but for ties closer than 2^-100 of it.
  [[nodiscard]] static double quotient(const BasicExact& left, const BasicExact& right);

 private:
  using Limb = std::uint64_t;
  static constexpr int limb_bits = 64;
  static constexpr int capacity = limb_count;

  /// left / right to a relative error of at most 2^-50, unless it underflows.
  static double rough_quotient(const BasicExact& left, const BasicExact& right);
  static BasicExact add(const BasicExact& left, const BasicExact& right, int right_sign);
  static BasicExact product(const BasicExact& left, const BasicExact& right);
  static BasicExact add_magnitudes(const BasicExact& left, const BasicExact& right, int sign);
  static BasicExact subtract_magnitudes(const BasicExact& left, const BasicExact& right, int sign);
  static int compare_magnitudes(const BasicExact& left, const BasicExact& right);
  void copy(const BasicExact& other) {
    sign_ = other.sign_;
    exponent_ = other.exponent_;
    size_ = other.size_;
    std::copy_n(other.limbs_.begin(), size_, limbs_.begin());
  }
  void copy_shifted(const BasicExact& other, int bottom, int size);
  void trim();
  [[nodiscard]] int top() const { return exponent_ + size_; }
  Limb& limb(int index) { return limbs_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] Limb limb(int index) const { return limbs_[static_cast<std::size_t>(index)]; }
  /// The limb at an index of the number's own scale, or 0 where it has none.
  [[nodiscard]] Limb limb_at(int position) const {
    const int index = position - exponent_;
    return index >= 0 && index < size_ ? limb(index) : 0;
  }

  int sign_ = 0;
  int exponent_ = 0;                               ///< of the lowest limb, in limbs
  int size_ = 0;                                   ///< limbs in use. Neither the lowest nor the highest is 0
  std::array<Limb, std::size_t{capacity}> limbs_;  ///< lowest first. Only the first size_ are ever read
};

template <int limb_count>
inline BasicExact<limb_count>::BasicExact(double value) {
  if (value == 0) return;
  assert(std::isfinite(value));
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto biased_exponent = static_cast<int>(bits >> 52U & 0x7ffU);
  Limb mantissa = bits & ((Limb{1} << 52U) - 1);
  if (biased_exponent > 0) mantissa |= Limb{1} << 52U;
  const int exponent = std::max(biased_exponent, 1) - 1075;  // value = mantissa · 2^exponent
  sign_ = value > 0 ? 1 : -1;
  exponent_ = exponent >> 6;  // rounded down
  const auto shift = static_cast<unsigned>(exponent) % unsigned{limb_bits};
  const Limb low = mantissa << shift;
  const Limb high = shift == 0 ? 0 : mantissa >> (limb_bits - shift);
  if (low == 0) {
    ++exponent_;
    limbs_[0] = high;
    size_ = 1;
  } else {
    limbs_[0] = low;
    limbs_[1] = high;
    size_ = high == 0 ? 1 : 2;
  }
}

template <int limb_count>
inline BasicExact<limb_count> BasicExact<limb_count>::difference(double to, double from) {
  // The error of rounding (Knuth). Finite doubles up to 2^121 do not overflow.
  const double rounded = to - from;
  const double of_from = rounded - to;
  const double left_over = (to - (rounded - of_from)) - (from + of_from);
  if (left_over == 0) return {rounded};
  return BasicExact(to) - BasicExact(from);
}

/// Its capacity is enough for products of ten coordinate differences, the highest degree that the kernels
/// compare. Coordinates go from the smallest denormal, 2^-1074, to 2^121: (1195 + 4) · 10 bits < 64 · 192.
using Exact = BasicExact<192>;

/// Its capacity is enough for products of 61 coordinate differences, the highest degree that is needed where
/// features move: (1195 + 8) · 61 bits < 64 · 1152.
using WideExact = BasicExact<1152>;

}  // namespace graze
