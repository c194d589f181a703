// Distances at the threshold to the last bit, and coordinates at the ends of the range of doubles.

#include <cmath>
#include <iostream>

#include "core/comparison.hpp"
#include "hard_cases/scene_comparison.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

constexpr double smallest = std::numeric_limits<double>::denorm_min();

Shape scaled(Shape shape, double factor) {
  return mapped(std::move(shape), factor, Vector3d::Zero());
}

DiagnosticKind only_kind(const FrameReport& report) {
  REQUIRE(report.diagnostics().size() == 1);
  return report.diagnostics()[0].kind;
}

}  // namespace

TEST_CASE("threshold: equal, one unit below and one above the distance of random scenes") {
  Tally tally;
  std::size_t exactly = 0;
  for (std::uint64_t seed = 0; seed < repeats(240); ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    INFO("seed " << seed);
    for (const bool vertices : {false, true}) {
      const oracle::Pair distance =
          vertices ? oracle::vertex_distance(given.a, given.b) : oracle::surface_distance(given.a, given.b);
      const double down = distance.distance_down;
      const double up = distance.distance_up;
      exactly += down == up && up > 0 ? 1U : 0U;
      for (const double threshold : {std::nextafter(down, 0.0), down, up, std::nextafter(up, infinity)})
        for (const ContactDetail detail : all_details)
          if (is_about_vertices(detail) == vertices) tally.compare({given.a, given.b}, threshold, detail);
    }
  }
  CHECK(exactly > repeats(50));
  CHECK(tally.contacts > repeats(1000));
  tally.print("a threshold beside the distance");
}

TEST_CASE("threshold: a distance equal to it is no contact, the next double is one") {
  // The distance of the tip is that of its three offsets, exact where they are multiples of (1, 2, 2) / 3.
  Tally tally;
  for (const double unit : {1.0, 0.1, 0x1.fffffffffffffp-3, 0x1p-300, 0x1p100}) {
    INFO("unit " << unit);
    const Shape ground = triangle({0, 0, 0}, Vector3d(-1, 0, -1) * unit, Vector3d(0, -1, -1) * unit);
    const Shape tip = mapped(triangle({0, 0, 0}, {1, 0, 9}, {0, 1, 9}), unit, Vector3d(2, 4, 4) * unit);
    const double distance = 6 * unit;  // exactly, but for 0.1 and its like, where the oracle says which side
    tally.compare({ground, tip}, distance);
    tally.compare({ground, tip}, std::nextafter(distance, 0));
    const std::size_t before = tally.contacts;
    tally.compare({ground, tip}, std::nextafter(distance, distance * 2));
    CHECK(tally.contacts > before);
  }
  const Shape ground = triangle({0, 0, 0}, {-1, 0, -1}, {0, -1, -1});
  const Shape tip = mapped(triangle({0, 0, 0}, {1, 0, 9}, {0, 1, 9}), 1, {2, 4, 4});
  CHECK_FALSE(detect(surface_of(ground), surface_of(tip), query_of(ContactDetail::features, 6)).in_contact);
  tally.print("a threshold equal to the distance");
}

TEST_CASE("coordinates near the largest and smallest doubles: up to 2^120, down to where squares vanish") {
  Tally tally;
  for (const int exponent : {116, 100, -200, -300, -505, -520, -530, -536, -540, -1000}) {
    const double factor = std::ldexp(1.0, exponent);
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
      const oracle::RandomScene given = oracle::random_scene(seed);
      INFO("seed " << seed << ", factor 2^" << exponent);
      tally.compare({scaled(given.a, factor), scaled(given.b, factor)}, given.threshold * factor);
    }
  }
  CHECK(tally.contacts > 2000);
  tally.print("extreme size");
}

TEST_CASE("coordinates near the largest and smallest doubles: denormals") {
  Tally tally;
  for (const double unit : {4 * smallest, 12 * smallest, 0x1p-1030}) {
    for (std::uint64_t seed = 1; seed < 60; seed += 2) {  // on a grid of quarters
      const oracle::RandomScene given = oracle::random_scene(seed);
      INFO("seed " << seed << ", unit " << unit);
      tally.compare({scaled(snapped(given.a, 0.25), unit), scaled(snapped(given.b, 0.25), unit)},
                    given.threshold * unit);
    }
  }
  CHECK(tally.contacts > 500);
  tally.print("denormal size");
}

TEST_CASE("coordinates near the largest and smallest doubles: a huge shape and a tiny one") {
  Tally tally;
  for (const int exponent : {20, 60, 110}) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const Shape huge = scaled(oracle::random_scene(2 * seed + 1).a, std::ldexp(1.0, exponent));
      Shape tiny = scaled(oracle::random_scene(seed).b, std::ldexp(1.0, -exponent));
      const auto& face = huge.faces[seed % huge.faces.size()];
      const Vector3d middle =
          (huge.positions[face[0]] + huge.positions[face[1]] + huge.positions[face[2]]) / 4;
      if (seed % 2 == 0) tiny = mapped(tiny, 1, middle);  // else about the origin, where huge may pass
      INFO("seed " << seed << ", 2^" << exponent);
      tally.compare({huge, tiny},
                    std::ldexp(seed % 3 == 0 ? 0.25 : 4.0, seed % 3 == 0 ? -exponent : exponent));
    }
  }
  CHECK(tally.contacts > 500);
  tally.print("a huge and a tiny shape");
}

TEST_CASE("coordinates near the largest and smallest doubles: a diagnostic beyond 2^120") {
  const double largest = 0x1p120;
  const Shape cube = box({0, 0, 0}, {1, 1, 1});
  std::size_t compared = 0;
  for (const double beyond :
       {std::nextafter(largest, infinity), 2 * largest, std::numeric_limits<double>::max()})
    for (const double sign : {1.0, -1.0})
      for (int axis = 0; axis < 3; ++axis) {
        Shape bad = cube;
        bad.positions[5][axis] = sign * beyond;
        CHECK_THROWS_AS(mesh_of(bad), Error);

        BodyScene scene({cube, cube}, settings_of(0.5, infinity));
        Scene& running = scene.scene();
        running.set_positions(scene.ids()[1], bad.positions);
        const ReportHandle copied = running.step();
        CHECK(only_kind(*copied) == DiagnosticKind::too_large);
        CHECK(copied->diagnostics()[0].object == scene.ids()[1]);
        CHECK(copied->diagnostics()[0].message.find("vertex 5") != std::string::npos);
        CHECK(only_pair(*copied).distance.upper == 0);
        running.bind_positions(scene.ids()[1], bad.positions);
        CHECK(only_kind(*running.step()) == DiagnosticKind::too_large);
        CHECK(only_pair(*running.latest_report()).stale);

        Shape good = cube;
        good.positions[5][axis] = sign * largest;
        running.bind_positions(scene.ids()[1], good.positions);
        const ReportHandle taken = running.step();
        CHECK(taken->diagnostics().empty());
        const Expected expected = expected_of(cube, good, 0.5, ContactDetail::features);
        CHECK(difference_of(taken->contacts(), expected.contacts, Tolerance(cube, good)) == "");
        ++compared;
      }
  std::cout << "compared " << compared << " coordinates at and beyond 2^120\n";
}

}  // namespace graze::tests
