#include "exact.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace graze {
namespace {

constexpr int limb_bits = 32;

int floor_div(int value, int divisor) {
  return value >= 0 ? value / divisor : -((-value + divisor - 1) / divisor);
}

}  // namespace

Exact::Exact(double value) {
  if (value == 0) return;
  assert(std::isfinite(value));
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto biased_exponent = static_cast<int>(bits >> 52U & 0x7ffU);
  std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52U) - 1);
  if (biased_exponent > 0) mantissa |= std::uint64_t{1} << 52U;
  const int exponent = std::max(biased_exponent, 1) - 1075;  // value = mantissa · 2^exponent
  sign_ = value > 0 ? 1 : -1;
  exponent_ = floor_div(exponent, limb_bits);
  const int shift = exponent - exponent_ * limb_bits;  // 0 to 31: the mantissa spans at most three limbs
  const std::uint64_t low = mantissa << shift;
  const std::uint64_t high = shift == 0 ? 0 : mantissa >> (64 - shift);
  limbs_[0] = static_cast<std::uint32_t>(low);
  limbs_[1] = static_cast<std::uint32_t>(low >> limb_bits);
  limbs_[2] = static_cast<std::uint32_t>(high);
  size_ = 3;
  trim();
}

void Exact::copy(const Exact& other) {
  sign_ = other.sign_;
  exponent_ = other.exponent_;
  size_ = other.size_;
  std::copy_n(other.limbs_.begin(), size_, limbs_.begin());
}

void Exact::trim() {
  while (size_ > 0 && limbs_[static_cast<std::size_t>(size_ - 1)] == 0) --size_;
  const auto* const first =
      std::find_if(limbs_.begin(), limbs_.begin() + size_, [](std::uint32_t limb) { return limb != 0; });
  const auto zeros = static_cast<int>(first - limbs_.begin());
  if (zeros > 0 && zeros < size_) {
    std::copy(first, static_cast<const std::uint32_t*>(limbs_.begin() + size_), limbs_.begin());
    exponent_ += zeros;
    size_ -= zeros;
  }
  if (size_ == 0) {
    sign_ = 0;
    exponent_ = 0;
  }
}

Exact Exact::operator-() const {
  Exact result = *this;
  result.sign_ = -sign_;
  return result;
}

int Exact::compare_magnitudes(const Exact& left, const Exact& right) {
  const int left_top = left.exponent_ + left.size_;
  const int right_top = right.exponent_ + right.size_;
  if (left_top != right_top) return left_top < right_top ? -1 : 1;
  const int bottom = std::min(left.exponent_, right.exponent_);
  for (int position = left_top - 1; position >= bottom; --position) {
    const std::uint32_t left_limb = left.limb_at(position);
    const std::uint32_t right_limb = right.limb_at(position);
    if (left_limb != right_limb) return left_limb < right_limb ? -1 : 1;
  }
  return 0;
}

Exact Exact::add_magnitudes(const Exact& left, const Exact& right, int sign) {
  Exact sum;
  sum.sign_ = sign;
  sum.exponent_ = std::min(left.exponent_, right.exponent_);
  const int top = std::max(left.exponent_ + left.size_, right.exponent_ + right.size_);
  sum.size_ = top - sum.exponent_ + 1;
  assert(sum.size_ <= capacity);
  std::uint64_t carry = 0;
  for (int index = 0; index < sum.size_; ++index) {
    carry += std::uint64_t{left.limb_at(sum.exponent_ + index)} + right.limb_at(sum.exponent_ + index);
    sum.limbs_[static_cast<std::size_t>(index)] = static_cast<std::uint32_t>(carry);
    carry >>= limb_bits;
  }
  sum.trim();
  return sum;
}

/// left − right, for |left| ≥ |right|.
Exact Exact::subtract_magnitudes(const Exact& left, const Exact& right, int sign) {
  Exact difference;
  difference.sign_ = sign;
  difference.exponent_ = std::min(left.exponent_, right.exponent_);
  difference.size_ = left.exponent_ + left.size_ - difference.exponent_;
  assert(difference.size_ <= capacity);
  std::int64_t borrow = 0;
  for (int index = 0; index < difference.size_; ++index) {
    std::int64_t limb = std::int64_t{left.limb_at(difference.exponent_ + index)} -
                        std::int64_t{right.limb_at(difference.exponent_ + index)} + borrow;
    borrow = limb < 0 ? -1 : 0;
    if (limb < 0) limb += std::int64_t{1} << limb_bits;
    difference.limbs_[static_cast<std::size_t>(index)] = static_cast<std::uint32_t>(limb);
  }
  difference.trim();
  return difference;
}

Exact Exact::add(const Exact& left, const Exact& right, int right_sign) {
  if (right_sign == 0) return left;
  if (left.sign_ == 0) {
    Exact result = right;
    result.sign_ = right_sign;
    return result;
  }
  if (left.sign_ == right_sign) return add_magnitudes(left, right, right_sign);
  const int order = compare_magnitudes(left, right);
  if (order == 0) return {};
  return order > 0 ? subtract_magnitudes(left, right, left.sign_)
                   : subtract_magnitudes(right, left, right_sign);
}

Exact operator*(const Exact& left, const Exact& right) {
  Exact product;
  product.sign_ = left.sign_ * right.sign_;
  if (product.sign_ == 0) return product;
  product.exponent_ = left.exponent_ + right.exponent_;
  product.size_ = left.size_ + right.size_;
  assert(product.size_ <= Exact::capacity);
  std::fill_n(product.limbs_.begin(), product.size_, 0);
  for (int i = 0; i < left.size_; ++i) {
    std::uint64_t carry = 0;
    const std::uint64_t factor = left.limbs_[static_cast<std::size_t>(i)];
    for (int j = 0; j < right.size_; ++j) {
      auto& limb = product.limbs_[static_cast<std::size_t>(i + j)];
      carry += factor * right.limbs_[static_cast<std::size_t>(j)] + limb;
      limb = static_cast<std::uint32_t>(carry);
      carry >>= limb_bits;
    }
    product.limbs_[static_cast<std::size_t>(i + right.size_)] = static_cast<std::uint32_t>(carry);
  }
  product.trim();
  return product;
}

Exact::Scaled Exact::scaled() const {
  if (sign_ == 0) return {};
  double value = 0;  // the top three limbs hold at least 65 bits; each addition rounds once
  const int used = std::min(size_, 3);
  for (int index = size_ - used; index < size_; ++index)
    value = std::ldexp(value, -limb_bits) + limbs_[static_cast<std::size_t>(index)];
  Scaled result;
  result.fraction = sign_ * std::frexp(value, &result.exponent);
  result.exponent += (exponent_ + size_ - 1) * limb_bits;
  return result;
}

double Exact::rough_quotient(const Exact& left, const Exact& right) {
  const Scaled numerator = left.scaled();
  const Scaled denominator = right.scaled();
  return std::ldexp(numerator.fraction / denominator.fraction, numerator.exponent - denominator.exponent);
}

double Exact::quotient(const Exact& left, const Exact& right) {
  const double rough = rough_quotient(left, right);
  // What the rough quotient leaves over is exact; only this sum rounds.
  return rough + rough_quotient(left - Exact(rough) * right, right);
}

}  // namespace graze
