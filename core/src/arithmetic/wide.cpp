#include "arithmetic/wide.hpp"

namespace graze {

std::optional<double> rounded_quotient(double base, const Wide& numerator, const Wide& denominator) {
  const double least = std::abs(denominator.high) * (1 - 0x1p-50) - denominator.off();
  if (!(least > 0x1p-900)) return std::nullopt;
  const double first = numerator.high / denominator.high;
  const Wide after_first = numerator - denominator * Wide(first);
  const double second = after_first.high / denominator.high;
  const Wide left_over = after_first - denominator * Wide(second);
  const Wide sum = Wide::sum_of(base, first);
  const double rest = sum.low + second;
  const Wide result = Wide::sum_of(sum.high, rest);
  // The quotient's own error, that of `rest`, and what Exact::quotient and the two sums below may be off by.
  const double off = (std::abs(left_over.high) * (1 + 0x1p-50) + left_over.off()) / least * Wide::slack +
                     std::abs(rest) * Wide::ulp + std::abs(result.high) * 0x1p-98;
  const double low = result.high + (result.low - off);
  const double high = result.high + (result.low + off);
  if (!(low == high && std::abs(low) > 0x1p-900 && std::abs(low) < 0x1p900)) return std::nullopt;
  return low;
}

std::optional<Exact::Scaled> scaled(const Wide& number) {
  const double off = number.off() + std::abs(number.low) * Wide::ulp;
  if (!std::isfinite(number.high) || !std::isfinite(off)) return std::nullopt;
  // Leading bits never fall as a number grows, so that those of both ends are those of all between.
  const Exact high(number.high);
  const Exact::Scaled least = (high + Exact(number.low - off)).scaled();
  const Exact::Scaled most = (high + Exact(number.low + off)).scaled();
  if (least.fraction != most.fraction || least.exponent != most.exponent) return std::nullopt;
  return least;
}

}  // namespace graze
