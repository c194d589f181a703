// This test checks the slack that tests of leaf pairs leave for the next steps. While the surfaces hardly
// move, the slack must save tests of leaf pairs. Each answer must be that of a query that knows nothing of
// the steps before.

#include <array>
#include <iostream>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Shape;

/// Leaf pairs looked into after the first step.
struct Looks {
  std::uint64_t with_slack = 0;
  std::uint64_t without = 0;
};

/// One way to ask, with what it remembers.
struct Asking {
  PairQuery query;
  LeafFront front;
  PairDetector detector;
  PairAnswer answer;

  std::uint64_t ask(const Surface& a, const Surface& b) {
    PairCounters counters;
    detector.detect(a, b, query, front, answer, counters);
    return counters.leaf_pairs_tested;
  }
};

Looks tremble(const DriftingPair& rest, const PairQuery& query, double tremor) {
  Surface a = surface_of(rest.a);
  Surface b = surface_of(rest.b);
  Asking patient{query, {}, {}, {}};
  Asking hasty{query, {}, {}, {}};
  patient.query.slack = hasty.query.slack = 0.1;
  patient.query.leaf_test_slack = 16 * (2 * tremor + std::abs(rest.drift));
  Looks looks;
  for (int step = 0; step < 24; ++step) {
    const auto seed = static_cast<std::uint64_t>(step);
    const Eigen::Vector3d way(rest.apart + step * rest.drift, 0.03, 0.02);
    REQUIRE(a.set_positions(wobbled(rest.a, tremor, seed).positions).taken());
    REQUIRE(b.set_positions(mapped(wobbled(rest.b, tremor, seed + 50), 1, way).positions).taken());
    INFO(rest.name << ", step " << step << ", tremor " << tremor << ", threshold " << query.threshold);
    Asking afresh{query, {}, {}, {}};
    afresh.ask(a, b);
    const std::uint64_t with_slack = patient.ask(a, b);
    const std::uint64_t without = hasty.ask(a, b);
    check_same(patient.answer, afresh.answer);
    check_same(hasty.answer, afresh.answer);
    if (step == 0) continue;
    looks.with_slack += with_slack;
    looks.without += without;
  }
  return looks;
}

}  // namespace

TEST_CASE("leaf test slack: bounds of features spare leaf tests, and change no answer") {
  const FloatingPointScope scope;
  const Shape ball = shape_of(models::sphere(32, 24));
  const Shape block = shape_of(models::box({1, 1, 1}));
  const Shape ring = shape_of(models::torus(32, 16, 0.7, 0.3));
  // So few regions that the validators look at all pairs of them.
  const Shape pebble = shape_of(models::sphere(9, 6, models::Faces::quads));
  const Shape band = shape_of(models::torus(12, 8, 0.5, 0.2));
  const std::array all{DriftingPair{"balls apart", ball, turned(ball, 3), 2.02, 0},
                       DriftingPair{"balls through each other", ball, turned(ball, 3), 1.9, 0},
                       DriftingPair{"rings within each other", ring, turned(ring, 5), 0.05, 0},
                       DriftingPair{"blocks", block, block, 1.001, 0},
                       DriftingPair{"balls that part", ball, turned(ball, 4), 1.985, 2e-3},
                       DriftingPair{"balls that meet", ball, turned(ball, 4), 2.03, -2e-3},
                       DriftingPair{"pebbles apart", pebble, turned(pebble, 6), 2.05, 1e-4},
                       DriftingPair{"bands apart", band, turned(band, 7), 1.5, -1e-4},
                       DriftingPair{"a band about a pebble", band, turned(pebble, 8), 1.7, 1e-4}};
  Looks sum;
  for (const DriftingPair& rest : all)
    for (const ContactDetail detail : {ContactDetail::none, ContactDetail::closest})
      for (const double threshold : {0.0, 0.01})
        for (const double tremor : {0.0, 1e-6, 1e-4}) {
          PairQuery query = query_of(detail, threshold);
          query.reach = 0.5;
          const Looks looks = tremble(rest, query, tremor);
          if (detail != ContactDetail::none) continue;
          sum.with_slack += looks.with_slack;
          sum.without += looks.without;
        }
  CHECK(sum.without > 4000);
  CHECK(sum.with_slack * 3 < sum.without * 2);
  std::cout << sum.with_slack << " leaf tests with slack, " << sum.without << " without\n";
}

}  // namespace graze::tests
