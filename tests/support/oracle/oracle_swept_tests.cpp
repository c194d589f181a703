// The oracle of moving features against answers known by hand, and against itself at single times.

#include <cstdint>

#include "support/catch.hpp"
#include "support/oracle/oracle_swept.hpp"
#include "support/random/random_sweeps.hpp"

using namespace graze;
using namespace graze::oracle;

TEST_CASE("the oracle of moving features finds an irrational root of a polynomial") {
  // (2 t² − 1)² (3 t − 1)
  const IntegerPolynomial square = {-1, 0, 2};
  const auto roots = roots_in_unit_interval(product(product(square, square), {-1, 3}));
  REQUIRE(roots.size() == 2);
  CHECK(roots[0].compare(Rational(1, 3)) == 0);
  CHECK(roots[1].compare(Rational(7071, 10000)) > 0);
  CHECK(roots[1].compare(Rational(7072, 10000)) < 0);
  CHECK(roots[1].sign_of(square) == 0);
  CHECK(roots[1].sign_of({-7071, 10000}) > 0);
}

TEST_CASE("the oracle of moving features finds when a point falls on a triangle") {
  MovingPoints points;
  points.start = {{{0, 0, 1}, {-2, -2, 0}, {2, -2, 0}, {0, 3, 0}}};
  points.end = points.start;
  points.end[0].z() = -2;
  const auto time = first_meeting(points);
  REQUIRE(time.has_value());
  CHECK(time->compare(Rational(1, 3)) == 0);
  CHECK(squared_distance_at(points, Rational(1, 6)) == Rational(1, 4));
}

TEST_CASE("the oracle of moving features never finds a contact at a time before the first one") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    const MovingPoints points = random_sweep(seed);
    const auto first = first_meeting(points);
    for (int i = 0; i <= 16; ++i) {
      const Rational time = Rational(i) / 16;
      const bool touches = touch_at(points, time);
      CHECK(touches == (squared_distance_at(points, time) == 0));
      if (touches) CHECK((first && first->compare(time) <= 0));
      if (first && first->compare(time) == 0) CHECK(touches);
    }
  }
}
