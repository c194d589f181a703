#include "support/exact/exact.hpp"

#include <algorithm>
#include <cmath>
#ifdef GRAZE_NUMBERS_PAST_SANITIZERS
#include <cstddef>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void __libc_free(void* block);
}
#endif

namespace graze::oracle {

namespace {

#ifdef GRAZE_NUMBERS_PAST_SANITIZERS
/// Runs before any number is made: constructors with a priority run before those of static variables.
[[gnu::constructor(101)]] void allocate_numbers_past_sanitizers() {
  mp_set_memory_functions(
      [](std::size_t size) { return __libc_malloc(size); },
      [](void* number, std::size_t, std::size_t size) { return __libc_realloc(number, size); },
      [](void* number, std::size_t) { __libc_free(number); });
}
#endif

Rational scaled(const Rational& value, long exponent) {
  Rational result;
  if (exponent >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return result;
}

/// The e with 2^e ≤ value < 2^(e+1).
long floor_log2(const Rational& value) {
  const long e = static_cast<long>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
                 static_cast<long>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
  return scaled(value, -e) < 1 ? e - 1 : e;
}

/// The exponent of the last bit of a double whose leading bit is 2^e.
long last_bit(long e) {
  return std::max(e - 52, -1074L);
}

mpz_class floor_of(const Rational& value) {
  mpz_class result;
  mpz_fdiv_q(result.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  return result;
}

/// `whole` in units of 2^exponent, one more where the part cut off asks for it. `against_half` compares that
/// part with one half.
double assemble(mpz_class whole, long exponent, Rounding rounding, bool cut_off, int against_half) {
  const bool nearest_is_up = against_half > 0 || (against_half == 0 && mpz_odd_p(whole.get_mpz_t()) != 0);
  if (cut_off && (rounding == Rounding::up || (rounding == Rounding::nearest && nearest_is_up))) whole += 1;
  return std::ldexp(whole.get_d(), static_cast<int>(exponent));
}

Rounding mirrored(Rounding rounding) {
  if (rounding == Rounding::nearest) return rounding;
  return rounding == Rounding::up ? Rounding::down : Rounding::up;
}

}  // namespace

double round(const Rational& value, Rounding rounding) {
  if (value == 0) return 0;
  if (value < 0) return -round(Rational(-value), mirrored(rounding));
  const long unit = last_bit(floor_log2(value));
  const Rational in_units = scaled(value, -unit);
  const mpz_class whole = floor_of(in_units);
  const Rational rest = in_units - whole;
  return assemble(whole, unit, rounding, rest != 0, cmp(rest, Rational(1, 2)));
}

Eigen::Vector3d round(const Point& point) {
  return {round(point.x), round(point.y), round(point.z)};
}

double round_sqrt(const Rational& squared, Rounding rounding) {
  if (squared == 0) return 0;
  const long e = floor_log2(squared);
  const long unit = last_bit(e >= 0 ? e / 2 : -((1 - e) / 2));
  const Rational in_units = scaled(squared, -2 * unit);
  const mpz_class whole = sqrt(floor_of(in_units));
  const Rational half_squared = whole * whole + whole + Rational(1, 4);
  return assemble(whole, unit, rounding, whole * whole != in_units, cmp(in_units, half_squared));
}

}  // namespace graze::oracle
