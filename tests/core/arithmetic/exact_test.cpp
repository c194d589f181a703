// The exact numbers against GMP's rationals, that balls and wide numbers hold the true value, and that what
// wide numbers are rounded to is what exact ones are, on doubles of wild exponents.

#include "arithmetic/exact.hpp"

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

#include "arithmetic/arithmetic.hpp"
#include "arithmetic/wide.hpp"
#include "support/catch.hpp"
#include "support/exact/exact.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;

constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Any double up to 2^120: zero, denormals, powers of two and full mantissas. They are often near one
/// another, so that sums cancel.
double wild(Random& random) {
  const std::uint32_t form = random.below(10);
  if (form == 0) return 0;
  if (form == 1) return smallest * (1 + random.below(1000)) * (random.chance(0.5) ? 1 : -1);
  const double mantissa = form < 4 ? 1 : random.between(0.5, 1);
  const int exponent =
      form < 7 ? static_cast<int>(random.below(5)) : static_cast<int>(random.below(1194)) - 1073;
  return std::ldexp(random.chance(0.5) ? mantissa : -mantissa, exponent);
}

/// One number, held in each of the arithmetics that are compared.
struct Number {
  Exact exact;
  mpq_class truth;
  Ball ball;
  Wide wide;

  explicit Number(double value) : exact(value), truth(value), ball(value), wide(value) {}
  Number(Exact e, mpq_class t, Ball b, Wide w) : exact(e), truth(std::move(t)), ball(b), wide(w) {}
};

Number operator+(const Number& left, const Number& right) {
  return {left.exact + right.exact, left.truth + right.truth, left.ball + right.ball, left.wide + right.wide};
}
Number operator-(const Number& left, const Number& right) {
  return {left.exact - right.exact, left.truth - right.truth, left.ball - right.ball, left.wide - right.wide};
}
Number operator*(const Number& left, const Number& right) {
  return {left.exact * right.exact, left.truth * right.truth, left.ball * right.ball, left.wide * right.wide};
}

mpq_class times_power_of_two(mpq_class value, int exponent) {
  if (exponent >= 0)
    mpq_mul_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  else
    mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  return value;
}

/// |value - truth| ≤ |truth| · 2^-bits.
bool is_near(const mpq_class& value, const mpq_class& truth, int bits) {
  return abs(mpq_class(value - truth)) <= times_power_of_two(abs(truth), -bits);
}

/// The exact number's sign and leading bits are those of the truth.
void check_exact(const Number& number) {
  CHECK(number.exact.sign() == sgn(number.truth));
  const Exact::Scaled scaled = number.exact.scaled();
  const double size = std::abs(scaled.fraction);
  CHECK((size == 0 ? number.truth == 0 : size >= 0.5 && size < 1));
  CHECK(is_near(times_power_of_two(mpq_class(scaled.fraction), scaled.exponent), number.truth, 52));
}

/// The ball holds the truth, and a sign that it is sure of is right.
void check_ball(const Number& number) {
  bool unsure = false;
  const int sign_of_ball = sign(number.ball, unsure);
  if (!unsure) CHECK(sign_of_ball == sgn(number.truth));
  if (!std::isfinite(number.ball.value) || !std::isfinite(number.ball.radius)) return;
  const mpq_class off = abs(mpq_class(mpq_class(number.ball.value) - number.truth));
  CHECK(off <= mpq_class(number.ball.radius) * mpq_class(Ball::slack));
}

/// The wide number holds the truth, and what it is sure of is right.
void check_wide(const Number& number) {
  bool unsure = false;
  const int sign_of_wide = sign(number.wide, unsure);
  if (!unsure) CHECK(sign_of_wide == sgn(number.truth));
  if (const auto leading = scaled(number.wide)) {
    CHECK(leading->fraction == number.exact.scaled().fraction);
    CHECK(leading->exponent == number.exact.scaled().exponent);
  }
  if (!std::isfinite(number.wide.high) || !std::isfinite(number.wide.radius)) return;
  const mpq_class middle = mpq_class(number.wide.high) + mpq_class(number.wide.low);
  CHECK(abs(mpq_class(middle - number.truth)) <= mpq_class(number.wide.radius) * mpq_class(Wide::slack));
  CHECK(number.wide.high + number.wide.low == number.wide.high);
}

/// A random sum, difference or product of what there is, of at most ten coordinate differences.
struct Expression {
  Number value;
  int degree;
};

Expression combined(Random& random, const Expression& left, const Expression& right) {
  const std::uint32_t operation = random.below(3);
  if (operation == 2 && left.degree + right.degree <= 10)
    return {left.value * right.value, left.degree + right.degree};
  const int degree = std::max(left.degree, right.degree);
  return {operation == 0 ? left.value + right.value : left.value - right.value, degree};
}

}  // namespace

TEST_CASE("exact: every double is itself") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) check_exact(Number(wild(random)));
  for (const double value :
       {0.0, -0.0, smallest, -smallest, 0x1p-1022, 0x1p120, -0x1p120, 0x1.fffffffffffffp119})
    check_exact(Number(value));
}

TEST_CASE("exact: sums, differences and products are those of rationals") {
  Random random(2);
  int zeros = 0;
  int expressions = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Expression> pool;
    for (int i = 0; i < 4; ++i) {
      const std::array terms{Number(wild(random)), Number(wild(random))};
      pool.push_back({terms[0] - terms[1], 1});
    }
    for (int i = 0; i < 12; ++i) {
      const Expression& left = pool[random.below(static_cast<std::uint32_t>(pool.size()))];
      const Expression& right = pool[random.below(static_cast<std::uint32_t>(pool.size()))];
      const Expression next = combined(random, left, right);
      check_exact(next.value);
      check_exact({-next.value.exact, -next.value.truth, -next.value.ball, -next.value.wide});
      check_ball(next.value);
      check_wide(next.value);
      const int order = (left.value.exact - right.value.exact).sign();
      CHECK(order == sgn(mpq_class(left.value.truth - right.value.truth)));
      zeros += next.value.exact.sign() == 0 ? 1 : 0;
      ++expressions;
      pool.push_back(next);
    }
  }
  CHECK(zeros > 50);
  std::cout << "compared " << expressions << " expressions, " << zeros << " of them zero\n";
}

TEST_CASE("exact: ten factors from the smallest denormal to 2^121 fit") {
  for (const double size : {smallest, 0x1p120}) {
    const Number spread = Number(0x1.fffffffffffffp120) - Number(-smallest);
    Number product(1);
    Number power(1);
    for (int i = 0; i < 10; ++i) {
      product = product * spread;
      power = power * Number(size);
    }
    check_exact(product);
    check_exact(power);
    check_exact(product - power);
    check_exact(power - product);
  }
}

TEST_CASE("exact: quotients are rounded to nearest") {
  Random random(3);
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto number = [&] { return Number(wild(random)); };
    const std::array terms{number(), number(), number(), number(), number(), number()};
    const Number left = terms[0] * terms[1] - terms[2];
    const Number right = terms[3] - terms[4] * terms[5];
    if (right.truth == 0) continue;
    const mpq_class truth = left.truth / right.truth;
    const mpq_class size = abs(truth);
    if (truth != 0 && (size < mpq_class(0x1p-1000) || size > mpq_class(0x1p1000))) continue;
    CHECK(Exact::quotient(left.exact, right.exact) == oracle::round(truth));
    ++compared;
  }
  CHECK(compared > 1000);
}

TEST_CASE("exact: ratios compare as rationals do") {
  Random random(4);
  int equal = 0;
  for (int i = 0; i < 3000; ++i) {
    const double p = wild(random);
    const double q = std::abs(wild(random)) + smallest;
    const double factor = random.chance(0.3) ? 3 : random.between(1, 4);
    const double r = random.chance(0.5) ? p * factor : wild(random);
    const double s = random.chance(0.5) ? q * factor : std::abs(wild(random)) + smallest;
    const int truth = cmp(mpq_class(mpq_class(p) / mpq_class(q)), mpq_class(mpq_class(r) / mpq_class(s)));
    const int expected = truth > 0 ? 1 : (truth < 0 ? -1 : 0);
    bool unsure = false;
    CHECK(graze::compare<Exact>({p, q}, {r, s}, unsure) == expected);
    CHECK_FALSE(unsure);
    DecisionCount count;
    CHECK(decide(count, [&]<typename Number>(bool& is_unsure) {
            return graze::compare<Number>({Number(p), Number(q)}, {Number(r), Number(s)}, is_unsure);
          }) == expected);
    equal += expected == 0 ? 1 : 0;
  }
  CHECK(equal > 100);
}

TEST_CASE("exact: a decision goes to exact arithmetic only where doubles are unsure") {
  DecisionCount count;
  /// The sign of p·q − r·s.
  const auto compare_products = [&](double p, double q, double r, double s) {
    return decide(count, [&]<typename Number>(bool& unsure) {
      return sign(Number(p) * Number(q) - Number(r) * Number(s), unsure);
    });
  };
  CHECK(compare_products(2, 3, 1, 5) == 1);
  CHECK(compare_products(1 + 0x1p-20, 1 - 0x1p-20, 1, 1) == -1);
  CHECK(count.exact == 0);
  CHECK(compare_products(1 + 0x1p-30, 1 - 0x1p-30, 1, 1) == -1);  // the product rounds to 1
  CHECK(count.exact == 1);
  CHECK(compare_products(0x1p-600, 0x1p-600, 0x1p-601, 0x1p-600) == 1);  // both underflow
  CHECK(count.exact == 2);
  CHECK(compare_products(3, 4, 2, 6) == 0);  // equal is never certain of rounded numbers
  CHECK(count.exact == 3);
}

namespace {

/// A number of ordinary size, now and then on a grid.
double ordinary(Random& random) {
  return random.chance(0.2) ? random.below(9) / 4.0 - 1 : random.between(-2, 2);
}

/// The product of two and the difference of two such products: much of it cancels where they are alike.
Number nearly_cancelled(Random& random) {
  const Number x(ordinary(random));
  const Number y(ordinary(random));
  const double number = ordinary(random);
  const double off = std::ldexp(number, -static_cast<int>(random.below(60)));
  return (x * y - Number(x.ball.value + off) * Number(y.ball.value - off)) * Number(ordinary(random));
}

}  // namespace

TEST_CASE("wide: what is rounded is what exact arithmetic rounds to") {
  Random random(4);
  int rounded = 0;
  int leading = 0;
  constexpr int rounds = 20000;
  for (int round = 0; round < rounds; ++round) {
    const Number top = nearly_cancelled(random);
    const Number bottom = nearly_cancelled(random);
    const double base = random.chance(0.3) ? 0 : ordinary(random);
    check_wide(top);
    leading += scaled(top.wide) ? 1 : 0;
    if (bottom.exact.sign() == 0) continue;
    const auto quotient = rounded_quotient(base, top.wide, bottom.wide);
    if (!quotient) continue;
    CHECK(*quotient == Exact::quotient(Exact(base) * bottom.exact + top.exact, bottom.exact));
    ++rounded;
  }
  CHECK(rounded > rounds / 2);
  CHECK(leading > rounds / 2);
  std::cout << "rounded " << rounded << " quotients and " << leading << " numbers of " << rounds << '\n';
}

TEST_CASE("wide: a quotient halfway between two doubles is left to exact arithmetic") {
  const double half_way = 0x1p-53;
  CHECK_FALSE(rounded_quotient(1, Wide(half_way), Wide(1)).has_value());
  CHECK(rounded_quotient(1, Wide(half_way) * Wide(1 + 0x1p-30), Wide(1)) == 1 + 0x1p-52);
  CHECK(rounded_quotient(1, Wide(half_way) * Wide(1 - 0x1p-30), Wide(1)) == 1.0);
  CHECK_FALSE(rounded_quotient(1, Wide(-1), Wide(1)).has_value());
}

}  // namespace graze::tests
