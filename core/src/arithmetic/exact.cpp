#include "arithmetic/exact.hpp"

#include "core/base/compiler.hpp"

namespace graze {
namespace {

using Limb = std::uint64_t;

struct Product {
  Limb low, high;
};
Product multiply(Limb left, Limb right) {
#if GRAZE_EXTENSIONS && defined(__SIZEOF_INT128__)
  __extension__ using Double = unsigned __int128;
  const Double product = Double{left} * right;
  return {static_cast<Limb>(product), static_cast<Limb>(product >> 64U)};
#else
  constexpr Limb half = 0xffffffff;
  const Limb low = (left & half) * (right & half);
  const Limb first = (left >> 32U) * (right & half) + (low >> 32U);
  const Limb second = (left & half) * (right >> 32U) + (first & half);
  return {second << 32U | (low & half), (left >> 32U) * (right >> 32U) + (first >> 32U) + (second >> 32U)};
#endif
}

/// left + right + carry, which is 0 or 1 before and after.
Limb add_limbs(Limb left, Limb right, Limb& carry) {
  const Limb sum = left + right;
  const Limb whole = sum + carry;
  carry = (sum < left ? 1U : 0U) | (whole < sum ? 1U : 0U);
  return whole;
}
/// left − right − borrow, which is 0 or 1 before and after.
Limb subtract_limbs(Limb left, Limb right, Limb& borrow) {
  const Limb difference = left - right;
  const Limb whole = difference - borrow;
  borrow = (left < right ? 1U : 0U) | (difference < borrow ? 1U : 0U);
  return whole;
}

}  // namespace

/// The limbs of another number on a scale that begins at `bottom`, and zeros around them.
template <int limb_count>
void BasicExact<limb_count>::copy_shifted(const BasicExact& other, int bottom, int size) {
  assert(size <= capacity);
  exponent_ = bottom;
  size_ = size;
  Limb* const first = limbs_.data();
  Limb* const begin = std::fill_n(first, other.exponent_ - bottom, Limb{0});
  Limb* const end = std::copy_n(other.limbs_.data(), other.size_, begin);
  std::fill(end, first + size, Limb{0});
}

template <int limb_count>
void BasicExact<limb_count>::trim() {
  while (size_ > 0 && limb(size_ - 1) == 0) --size_;
  if (size_ == 0) {
    sign_ = exponent_ = 0;
    return;
  }
  if (limb(0) != 0) return;
  int zeros = 1;
  while (limb(zeros) == 0) ++zeros;
  size_ -= zeros;
  exponent_ += zeros;
  std::copy_n(limbs_.data() + zeros, size_, limbs_.data());
}

template <int limb_count>
BasicExact<limb_count> BasicExact<limb_count>::operator-() const {
  BasicExact result = *this;
  result.sign_ = -sign_;
  return result;
}

template <int limb_count>
int BasicExact<limb_count>::compare_magnitudes(const BasicExact& left, const BasicExact& right) {
  if (left.top() != right.top()) return left.top() < right.top() ? -1 : 1;
  const int bottom = std::min(left.exponent_, right.exponent_);
  for (int position = left.top() - 1; position >= bottom; --position) {
    const Limb left_limb = left.limb_at(position);
    const Limb right_limb = right.limb_at(position);
    if (left_limb != right_limb) return left_limb < right_limb ? -1 : 1;
  }
  return 0;
}

template <int limb_count>
BasicExact<limb_count> BasicExact<limb_count>::add_magnitudes(const BasicExact& left, const BasicExact& right,
                                                              int sign) {
  BasicExact sum;
  sum.sign_ = sign;
  const int bottom = std::min(left.exponent_, right.exponent_);
  sum.copy_shifted(left, bottom, std::max(left.top(), right.top()) - bottom + 1);
  int index = right.exponent_ - bottom;
  Limb carry = 0;
  for (int i = 0; i < right.size_; ++i, ++index)
    sum.limb(index) = add_limbs(sum.limb(index), right.limb(i), carry);
  for (; carry != 0; ++index) sum.limb(index) = add_limbs(sum.limb(index), 0, carry);
  sum.trim();
  return sum;
}

/// left − right, for |left| > |right|.
template <int limb_count>
BasicExact<limb_count> BasicExact<limb_count>::subtract_magnitudes(const BasicExact& left,
                                                                   const BasicExact& right, int sign) {
  BasicExact difference;
  difference.sign_ = sign;
  const int bottom = std::min(left.exponent_, right.exponent_);
  difference.copy_shifted(left, bottom, left.top() - bottom);
  int index = right.exponent_ - bottom;
  Limb borrow = 0;
  for (int i = 0; i < right.size_; ++i, ++index)
    difference.limb(index) = subtract_limbs(difference.limb(index), right.limb(i), borrow);
  for (; borrow != 0; ++index) difference.limb(index) = subtract_limbs(difference.limb(index), 0, borrow);
  difference.trim();
  return difference;
}

template <int limb_count>
BasicExact<limb_count> BasicExact<limb_count>::add(const BasicExact& left, const BasicExact& right,
                                                   int right_sign) {
  if (right_sign == 0) return left;
  if (left.sign_ == 0) {
    BasicExact result = right;
    result.sign_ = right_sign;
    return result;
  }
  if (left.sign_ == right_sign) return add_magnitudes(left, right, right_sign);
  const int order = compare_magnitudes(left, right);
  if (order == 0) return {};
  return order > 0 ? subtract_magnitudes(left, right, left.sign_)
                   : subtract_magnitudes(right, left, right_sign);
}

template <int limb_count>
BasicExact<limb_count> BasicExact<limb_count>::product(const BasicExact& left, const BasicExact& right) {
  BasicExact result;
  if (left.sign_ == 0 || right.sign_ == 0) return result;
  result.sign_ = left.sign_ * right.sign_;
  result.exponent_ = left.exponent_ + right.exponent_;
  result.size_ = left.size_ + right.size_;
  assert(result.size_ <= capacity);
  std::fill_n(result.limbs_.data(), right.size_, Limb{0});
  for (int i = 0; i < left.size_; ++i) {
    Limb carry = 0;
    const Limb factor = left.limb(i);
    for (int j = 0; j < right.size_; ++j) {
      const Product of_limbs = multiply(factor, right.limb(j));
      Limb low_carry = 0;
      Limb high_carry = 0;
      const Limb low = add_limbs(of_limbs.low, carry, low_carry);
      result.limb(i + j) = add_limbs(result.limb(i + j), low, high_carry);
      carry = of_limbs.high + low_carry + high_carry;  // a product of two limbs leaves room for both
    }
    result.limb(i + right.size_) = carry;
  }
  result.trim();
  return result;
}

template <int limb_count>
typename BasicExact<limb_count>::Scaled BasicExact<limb_count>::scaled() const {
  if (sign_ == 0) return {};
  // The top three halves of limbs hold at least 65 bits. Each addition rounds once.
  constexpr int half_bits = limb_bits / 2;
  const auto half_at = [&](int position) {
    const Limb whole = limb_at(position >> 1);
    return static_cast<std::uint32_t>(position % 2 != 0 ? whole >> half_bits : whole);
  };
  int position = 2 * top() - 1;
  if (half_at(position) == 0) --position;
  const double low = half_at(position - 2);
  const double middle = std::ldexp(low, -half_bits) + half_at(position - 1);
  const double value = std::ldexp(middle, -half_bits) + half_at(position);
  Scaled result;
  result.fraction = sign_ * std::frexp(value, &result.exponent);
  result.exponent += position * half_bits;
  return result;
}

template <int limb_count>
double BasicExact<limb_count>::rough_quotient(const BasicExact& left, const BasicExact& right) {
  const Scaled numerator = left.scaled();
  const Scaled denominator = right.scaled();
  return std::ldexp(numerator.fraction / denominator.fraction, numerator.exponent - denominator.exponent);
}

template <int limb_count>
double BasicExact<limb_count>::quotient(const BasicExact& left, const BasicExact& right) {
  const double rough = rough_quotient(left, right);
  // The remainder of the rough quotient is exact. Only this sum rounds.
  return rough + rough_quotient(left - BasicExact(rough) * right, right);
}

template class BasicExact<192>;
template class BasicExact<1152>;

}  // namespace graze
