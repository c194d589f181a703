// How far apart boxes are: never more than they are, hardly less, and nothing where they meet.

#include "core/base/box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"
#include "support/real.hpp"

namespace graze::tests {
namespace {

using oracle::Random;

/// The distance of two boxes with eleven more bits than a double, and a wider range.
Real distance_of(const Box& a, const Box& b) {
  Real squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Real below = static_cast<Real>(a.min[axis]) - b.max[axis];
    const Real above = static_cast<Real>(b.min[axis]) - a.max[axis];
    const Real gap = std::max({Real{0}, below, above});
    squared += gap * gap;
  }
  return std::sqrt(squared);
}

/// On a coarse grid, so that boxes overlap, touch and are apart along each axis, and some have no extent.
Box random_box(Random& random, double size) {
  Box box;
  for (int point = 0; point < 2; ++point) {
    const auto coordinate = [&] { return size * (static_cast<double>(random.below(9)) / 8 + 0x1p-30); };
    box.add(Eigen::Vector3d{coordinate(), coordinate(), coordinate()});
  }
  return box;
}

}  // namespace

TEST_CASE("box: a lower distance is at most the distance, and no less than rounding makes it") {
  Random random(1);
  std::array<int, 8> apart_along{};
  for (const double size : {1.0, 0x1p-530, 0x1p-300, 0x1p400}) {
    for (int i = 0; i < 20000; ++i) {
      const Box a = random_box(random, size);
      const Box b = random_box(random, size);
      unsigned apart = 0;
      for (int axis = 0; axis < 3; ++axis)
        if (a.min[axis] > b.max[axis] || b.min[axis] > a.max[axis]) apart |= 1U << axis;
      ++apart_along[apart];
      const double lower = lower_distance(a, b);
      const Real distance = distance_of(a, b);
      REQUIRE(lower == lower_distance(b, a));
      REQUIRE(lower <= distance);
      REQUIRE(lower >= distance * (1 - Real{0x1p-48}) - 2 * lost_to_underflow);
      if (apart == 0) REQUIRE(lower == 0);
      if (apart != 0 && size >= 0x1p-300) REQUIRE(lower > 0);
    }
  }
  for (const int count : apart_along) CHECK(count > 1000);
}

TEST_CASE("box: nothing is near an empty box") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box point;
  point.add(Eigen::Vector3d{1, 2, 3});
  CHECK(lower_distance(Box{}, point) == infinity);
  CHECK(lower_distance(point, Box{}) == infinity);
  CHECK(lower_distance(Box{}, Box{}) == infinity);
}

}  // namespace graze::tests
