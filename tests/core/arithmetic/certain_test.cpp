// This test compares every answer of certain.hpp, and of the kernels that ask the same of several features at
// once, with rational arithmetic. Whatever plain double is certain of must be what exact arithmetic says. The
// features are parallel, degenerate, at right angles, far away, minute and huge.

#include "arithmetic/certain.hpp"

#include <array>
#include <cmath>
#include <graze/instruction_set.hpp>
#include <iostream>
#include <optional>
#include <utility>

#include "core/answers/nearest_voronoi.hpp"
#include "kernels/voronoi.hpp"
#include "support/catch.hpp"
#include "support/exact/exact.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Rational;
using oracle::squared_length;

/// Corners of features that are hard in one way or another.
class Generator {
 public:
  enum Family : std::uint64_t { plain, grid, nearly_grid, needles, far, minute, huge, family_count };

  Generator(Family family, std::uint64_t seed) : family_(family), random_(seed) {}

  Vector3d point() {
    Vector3d point = random_.vector(-1, 1);
    if (family_ == grid || family_ == nearly_grid)
      for (int axis = 0; axis < 3; ++axis) point[axis] = static_cast<double>(random_.below(4));
    if (family_ == nearly_grid)
      for (int axis = 0; axis < 3; ++axis) point[axis] += std::ldexp(random_.between(-1, 1), -50);
    if (family_ == needles) point = Vector3d(point.x(), point.y() * 0x1p-24, point.z() * 0x1p-26);
    if (family_ == far) point += Vector3d(0x1p30, -0x1p33, 0x1p20);
    if (family_ == minute) point *= 0x1p-90;
    if (family_ == huge) point *= 0x1p90;
    return point;
  }

 private:
  Family family_;
  Random random_;
};

struct Tally {
  std::size_t compared = 0;
  std::size_t certain = 0;
  std::array<std::size_t, 9> places{};
};

/// On a grid many questions have the answer zero, and of needles plain double knows little. Elsewhere it is
/// certain of nearly all.
std::size_t least_percent(std::uint64_t family) {
  if (family == Generator::grid || family == Generator::nearly_grid) return 10;
  return family == Generator::needles ? 50 : 75;
}

void check_range(const SquaredRange& range, const Rational& truth) {
  REQUIRE(Rational(range.low) <= truth);
  REQUIRE(std::isfinite(range.high));
  REQUIRE(truth <= Rational(range.high));
}

using Corners = std::array<Vector3d, 3>;
using Ends = std::array<Vector3d, 2>;

void check_voronoi(const Vector3d& point, const Corners& corner, VoronoiRegion place,
                   const SquaredRange& range) {
  const NearestInTriangle expected = nearest_in_triangle(oracle::exact(point), exact_corners(corner));
  REQUIRE(place == expected.voronoi);
  check_range(range, expected.squared_distance);
}

void check_along(const Ends& a, const Ends& b, const std::array<Along, 2>& places,
                 const SquaredRange& range) {
  const NearestOfSegments expected = nearest_of_segments(exact_corners(a), exact_corners(b));
  REQUIRE(expected.is_unique);
  REQUIRE(places == expected.along);
  check_range(range, expected.squared_distance);
}

/// Every fifth pair is parallel, but for rounding.
std::pair<Ends, Ends> two_segments(Generator& generator, int number) {
  const Ends a{generator.point(), generator.point()};
  Ends b{generator.point(), generator.point()};
  if (number % 5 == 0) b[1] = b[0] + (a[1] - a[0]) * (number % 2 == 0 ? 1.0 : -0.5);
  return {a, b};
}

void put(const Vector3d& point, kernels::Points& points, std::size_t lane) {
  for (int axis = 0; axis < 3; ++axis) points[axis][lane] = point[axis];
}

/// Runs `kernel` on the batch with every instruction set and requires that all fill in the same as the first.
template <typename Batch, typename Kernel, typename SameVoronoi>
void run(Batch& batch, const Kernel& kernel, const SameVoronoi& same_voronoi) {
  const InstructionSet before = instruction_set();
  std::optional<Batch> first;
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    kernel(batch);
    if (!first) first = batch;
    for (std::size_t lane = 0; lane < kernels::contact_lanes; ++lane) {
      REQUIRE(batch.found.certain[lane] == first->found.certain[lane]);
      if (batch.found.certain[lane] == 0) continue;
      REQUIRE(same_voronoi(batch, *first, lane));
      REQUIRE(batch.found.low[lane] == first->found.low[lane]);
      REQUIRE(batch.found.high[lane] == first->found.high[lane]);
    }
  }
  use_instruction_set(before);
}

/// Checks one lane of a kernel's result against certain.cpp, and returns whether the kernel is certain. The
/// kernel must be certain wherever certain.cpp is (`is_certain`), and must then give the same range.
bool check_found(const kernels::VoronoiFound& found, std::size_t lane, bool is_certain,
                 const SquaredRange& range) {
  const bool kernel_is_certain = found.certain[lane] == 1;
  REQUIRE((kernel_is_certain || found.certain[lane] == 0));
  if (!is_certain) return kernel_is_certain;
  REQUIRE(kernel_is_certain);
  REQUIRE(found.low[lane] == range.low);
  REQUIRE(found.high[lane] == range.high);
  return true;
}

}  // namespace

TEST_CASE("certain: the Voronoi region of a triangle that a point lies in") {
  Tally all;
  for (std::uint64_t family = 0; family < Generator::family_count; ++family) {
    Generator generator(static_cast<Generator::Family>(family), family + 1);
    Tally tally;
    for (int i = 0; i < 1500; ++i) {
      const Vector3d point = generator.point();
      const std::array corner{generator.point(), generator.point(), generator.point()};
      ++tally.compared;
      VoronoiRegion place{};
      SquaredRange range;
      if (!certain_voronoi(point, corner, place, range)) continue;
      ++tally.certain;
      INFO("family " << family << ", case " << i);
      check_voronoi(point, corner, place, range);
      ++all.places[static_cast<std::size_t>(place)];
    }
    INFO("family " << family << ": " << tally.certain << " of " << tally.compared);
    CHECK(tally.certain * 100 >= tally.compared * least_percent(family));
    all.compared += tally.compared;
    all.certain += tally.certain;
  }
  for (std::size_t place = 0; place <= static_cast<std::size_t>(VoronoiRegion::inside); ++place)
    CHECK(all.places[place] > 100);
  std::cout << "compared " << all.certain << " certain Voronoi regions of triangles of " << all.compared
            << "\n";
}

TEST_CASE("certain: where on two segments their closest points lie") {
  Tally all;
  for (std::uint64_t family = 0; family < Generator::family_count; ++family) {
    Generator generator(static_cast<Generator::Family>(family), family + 20);
    Tally tally;
    for (int i = 0; i < 1500; ++i) {
      const auto [a, b] = two_segments(generator, i);
      ++tally.compared;
      std::array<Along, 2> places{};
      SquaredRange range;
      if (!certain_along(a, b, places, range)) continue;
      ++tally.certain;
      INFO("family " << family << ", case " << i);
      check_along(a, b, places, range);
      ++all.places[static_cast<std::size_t>(places[0]) * 3 + static_cast<std::size_t>(places[1])];
    }
    INFO("family " << family << ": " << tally.certain << " of " << tally.compared);
    CHECK(tally.certain * 100 >= tally.compared * least_percent(family));
    all.compared += tally.compared;
    all.certain += tally.certain;
  }
  for (const std::size_t count : all.places) CHECK(count > 100);
  std::cout << "compared " << all.certain << " certain closest points of segments of " << all.compared
            << "\n";
}

TEST_CASE("certain: several points and triangles at once") {
  std::size_t certain = 0;
  for (std::uint64_t family = 0; family < Generator::family_count; ++family) {
    Generator generator(static_cast<Generator::Family>(family), family + 80);
    for (int round = 0; round < 150; ++round) {
      std::array<Vector3d, kernels::contact_lanes> point;
      std::array<Corners, kernels::contact_lanes> corner;
      kernels::PointTriangleBatch batch{};
      for (std::size_t lane = 0; lane < kernels::contact_lanes; ++lane) {
        point[lane] = generator.point();
        corner[lane] = {generator.point(), generator.point(), generator.point()};
        put(point[lane], batch.point, lane);
        for (std::size_t i = 0; i < 3; ++i) put(corner[lane][i], batch.corner[i], lane);
      }
      run(
          batch, [](auto& asked) { kernels::voronoi().points_and_triangles(asked); },
          [](const auto& a, const auto& b, std::size_t lane) { return a.voronoi[lane] == b.voronoi[lane]; });
      for (std::size_t lane = 0; lane < kernels::contact_lanes; ++lane) {
        INFO("family " << family << ", round " << round << ", lane " << lane);
        VoronoiRegion place{};
        SquaredRange range;
        const bool is_certain = certain_voronoi(point[lane], corner[lane], place, range);
        if (!check_found(batch.found, lane, is_certain, range)) continue;
        ++certain;
        const auto found = static_cast<VoronoiRegion>(batch.voronoi[lane]);
        check_voronoi(point[lane], corner[lane], found, {batch.found.low[lane], batch.found.high[lane]});
      }
    }
  }
  CHECK(certain > 5000);
  std::cout << "compared " << certain << " Voronoi regions of eight triangles at once\n";
}

TEST_CASE("certain: several pairs of segments at once") {
  std::size_t certain = 0;
  for (std::uint64_t family = 0; family < Generator::family_count; ++family) {
    Generator generator(static_cast<Generator::Family>(family), family + 100);
    for (int round = 0; round < 150; ++round) {
      std::array<std::pair<Ends, Ends>, kernels::contact_lanes> segments;
      kernels::SegmentPairBatch batch{};
      for (std::size_t lane = 0; lane < kernels::contact_lanes; ++lane) {
        segments[lane] = two_segments(generator, round + static_cast<int>(lane));
        for (std::size_t end = 0; end < 2; ++end) {
          put(segments[lane].first[end], batch.a[end], lane);
          put(segments[lane].second[end], batch.b[end], lane);
        }
      }
      run(
          batch, [](auto& asked) { kernels::voronoi().segments(asked); },
          [](const auto& a, const auto& b, std::size_t lane) {
            return a.along_a[lane] == b.along_a[lane] && a.along_b[lane] == b.along_b[lane];
          });
      for (std::size_t lane = 0; lane < kernels::contact_lanes; ++lane) {
        INFO("family " << family << ", round " << round << ", lane " << lane);
        const auto& [a, b] = segments[lane];
        std::array<Along, 2> places{};
        SquaredRange range;
        const bool is_certain = certain_along(a, b, places, range);
        if (!check_found(batch.found, lane, is_certain, range)) continue;
        ++certain;
        check_along(a, b, {static_cast<Along>(batch.along_a[lane]), static_cast<Along>(batch.along_b[lane])},
                    {batch.found.low[lane], batch.found.high[lane]});
      }
    }
  }
  CHECK(certain > 5000);
  std::cout << "compared " << certain << " closest points of eight pairs of segments at once\n";
}

TEST_CASE("certain: whether a segment passes through a triangle") {
  std::size_t compared = 0;
  std::array<std::size_t, 3> answers{};
  for (std::uint64_t family = 0; family < Generator::family_count; ++family) {
    Generator generator(static_cast<Generator::Family>(family), family + 40);
    std::size_t certain = 0;
    constexpr std::size_t cases = 1500;
    for (std::size_t i = 0; i < cases; ++i) {
      const std::array segment{generator.point(), generator.point()};
      const std::array corner{generator.point(), generator.point(), generator.point()};
      const Passing passing = certain_passing(segment, corner);
      ++answers[static_cast<std::size_t>(passing)];
      if (passing == Passing::unsure) continue;
      ++certain;
      INFO("family " << family << ", case " << i);
      REQUIRE((passing == Passing::yes) == passes(exact_corners(segment), exact_corners(corner)));
    }
    INFO("family " << family << ": " << certain << " of " << cases);
    // The volumes of needles are hardly larger than their bounds.
    CHECK(certain * 100 >= cases * (family == Generator::needles ? 5 : least_percent(family)));
    compared += certain;
  }
  for (const std::size_t count : answers) CHECK(count > 100);
  std::cout << "compared " << compared << " certain passings\n";
}

TEST_CASE("certain: the squared distance of two points") {
  for (std::uint64_t family = 0; family < Generator::family_count; ++family) {
    Generator generator(static_cast<Generator::Family>(family), family + 60);
    for (int i = 0; i < 1500; ++i) {
      // Down to where squares underflow.
      const double scale = family == Generator::minute ? std::ldexp(1.0, -(i % 1000)) : 1;
      const Vector3d a = generator.point() * scale;
      const Vector3d b = generator.point() * scale;
      const SquaredRange range = squared_range(a, b);
      const Rational truth = squared_length(oracle::exact(b) - oracle::exact(a));
      INFO("family " << family << ", case " << i);
      check_range(range, truth);
      CHECK(range.high - range.low <= range.high * 0x1p-48 + 0x1p-998);
    }
  }
}

TEST_CASE("certain: a range of squared distances is below or beyond a limit, or neither") {
  const SquaredRange range{4, 9};
  CHECK(range.is_below(3.1));
  CHECK_FALSE(range.is_below(3));
  CHECK(range.is_beyond(1.9));
  CHECK_FALSE(range.is_beyond(2));
  CHECK_FALSE(range.is_below(2.5));
  CHECK_FALSE(range.is_beyond(2.5));
  CHECK_FALSE(SquaredRange{}.is_below(1e300));
  CHECK_FALSE(SquaredRange{}.is_beyond(0));
  CHECK_FALSE(SquaredRange{0x1p-1060, 1}.is_beyond(0x1p-540));  // the square of the limit is a denormal
}

}  // namespace graze::tests
