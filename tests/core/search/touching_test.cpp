// Surfaces that touched a step ago are looked at for that first: whether they still do or not, the answer is
// that of a query that knows nothing of it.

#include <array>
#include <cmath>
#include <iostream>
#include <limits>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Shape;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Meeting {
  const char* name;
  Shape a;
  Shape b;
  double wobble;
};

/// Towards each other, through and apart again, in steps of a 32nd: exact, so that what does not wobble
/// touches without piercing where its sides meet.
double away_at(int step) {
  return std::abs(step - 40) / 32.0 + 0.5;
}

struct Tally {
  std::size_t touched = 0;   ///< answers at distance 0
  std::size_t parted = 0;    ///< answers apart after one at distance 0
  std::size_t unwalked = 0;  ///< answers at distance 0 after one, from the listed leaves alone
  std::size_t in_turn = 0;   ///< answers at distance 0 after one, without a front or a walk that makes one
};

Tally compare_steps(const Meeting& meeting, PairQuery query) {
  Surface a = surface_of(meeting.a);
  Surface b = surface_of(meeting.b);
  LeafFront front;
  PairDetector detector;
  PairDetector of_nothing;
  Tally tally;
  for (int step = 0; step < 80; ++step) {
    const auto seed = static_cast<std::uint64_t>(step);
    REQUIRE(a.set_positions(wobbled(meeting.a, meeting.wobble, seed).positions).taken());
    REQUIRE(b.set_positions(
                 mapped(wobbled(meeting.b, meeting.wobble, seed + 100), 1, {away_at(step), 0, 0}).positions)
                .taken());
    if (step % 5 == 0) a.refit_faces();
    if (step % 7 == 0) b.refit_faces();
    INFO(meeting.name << ", step " << step << ", threshold " << query.threshold);
    const bool touched = front.touched;
    const Travel travel = front.travel_a;
    const bool is_served = front.unlisted_lower_bound_now(a, b) > 0;
    PairAnswer answer;
    PairAnswer afresh;
    PairCounters counters;
    LeafFront no_front;
    detector.detect(a, b, query, front, answer, counters);
    PairCounters counters_afresh;
    of_nothing.detect(a, b, query, no_front, afresh, counters_afresh);
    check_same(answer, afresh);
    if (!lists_piercings(query.detail))  // others look for the closest points alone
      REQUIRE(front.touched == (answer.listed && answer.distance.upper == 0));
    tally.touched += front.touched ? 1U : 0U;
    tally.parted += touched && !front.touched ? 1U : 0U;
    const bool unwalked = counters.region_pairs_tested == counters.leaf_pairs_tested &&
                          counters_afresh.region_pairs_tested > counters_afresh.leaf_pairs_tested;
    tally.unwalked += touched && front.touched && unwalked ? 1U : 0U;
    const bool is_front_left =
        front.travel_a.epoch == travel.epoch && front.travel_a.distance == travel.distance;
    tally.in_turn += touched && front.touched && !is_served && is_front_left ? 1U : 0U;
  }
  return tally;
}

}  // namespace

TEST_CASE(
    "touching: that surfaces touched a step ago does not show in where they do now, or how far they are") {
  const FloatingPointScope scope;
  const Shape ball = shape_of(models::sphere(24, 16));
  const Shape block = shape_of(models::box({1, 1, 1}));
  const std::array all{Meeting{"balls", ball, turned(ball, 3), 0.01}, Meeting{"blocks", block, block, 0},
                       Meeting{"soups", random_soup(1, 60, 90), random_soup(4, 60, 90), 0.01},
                       Meeting{"ball and soup", ball, mapped(random_soup(7, 60, 80), 0.5, {0, 0, 0}), 0},
                       Meeting{"soup and ball", random_soup(7, 60, 80), ball, 0.01}};
  Tally sum;
  for (const Meeting& meeting : all)
    for (const ContactDetail detail : surface_details) {
      if (!at_full_effort && detail != ContactDetail::none && detail != ContactDetail::nearest) continue;
      for (const double threshold : {0.0, 0.02})
        for (const auto& [reach, slack, leaf_test_slack] :
             {std::array{infinity, 0.25, 0.0}, {0.3, 0.25, 0.1}, {infinity, 1e-3, 0.01}}) {
          PairQuery query = query_of(detail, threshold);
          query.reach = reach;
          query.slack = slack;
          query.leaf_test_slack = leaf_test_slack;
          const Tally tally = compare_steps(meeting, query);
          if (detail != ContactDetail::none) continue;
          sum.touched += tally.touched;
          sum.parted += tally.parted;
          sum.unwalked += tally.unwalked;
          sum.in_turn += tally.in_turn;
        }
    }
  CHECK(sum.touched > 300);
  CHECK(sum.parted >= 8);
  CHECK(sum.unwalked > 200);
  CHECK(sum.in_turn > 100);
  std::cout << sum.touched << " answers at distance 0, " << sum.unwalked << " of them from listed leaves and "
            << sum.in_turn << " in turn, " << sum.parted << " partings\n";
}

TEST_CASE("touching: that middle vertices are in one place shows in no witness") {
  const FloatingPointScope scope;
  const Shape ball = shape_of(models::sphere(24, 16));
  PairDetector detector;
  PairCounters counters;
  for (const double threshold : {0.0, 0.02}) {
    const PairQuery query = query_of(ContactDetail::none, threshold);
    Surface a = surface_of(ball);
    Surface b = surface_of(ball);
    LeafFront front;
    PairAnswer answer;
    PairAnswer afresh;
    for (const double away : {0.0, 0.125, 0.25}) {
      const Shape moved = mapped(ball, 1, {away, 0, 0});
      REQUIRE(a.set_positions(moved.positions).taken());
      REQUIRE(b.set_positions(moved.positions).taken());
      detector.detect(a, b, query, front, answer, counters);
      detector.detect(a, b, query, afresh, counters);
      INFO("threshold " << threshold << ", " << away << " away");
      check_same(answer, afresh);
      CHECK(answer.distance.upper == 0);
    }
  }
}

TEST_CASE("touching: surfaces on a grid that part by less than the slack of leaf tests") {
  const FloatingPointScope scope;
  PairDetector detector;
  PairDetector of_nothing;
  std::size_t parted = 0;
  for (std::uint64_t seed = 1; seed < 2'400; seed += 2) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    if (oracle::surface_distance(given.a, given.b).distance_up > 0) continue;
    Surface a = surface_of(given.a);
    Surface b = surface_of(given.b);
    oracle::Random random(seed);
    const Eigen::Vector3d by = random.vector(-0.01, 0.01);
    PairQuery query = query_of(ContactDetail::none, given.threshold);
    query.slack = 0.01;
    query.leaf_test_slack = 0.1;
    LeafFront front;
    PairAnswer answer;
    PairCounters counters;
    detector.detect(a, b, query, front, answer, counters);
    REQUIRE(b.set_positions(mapped(given.b, 1, {by.x(), by.y(), 0}).positions).taken());
    PairAnswer afresh;
    detector.detect(a, b, query, front, answer, counters);
    of_nothing.detect(a, b, query, afresh, counters);
    INFO("seed " << seed);
    check_same(answer, afresh);
    parted += afresh.distance.upper > 0 ? 1U : 0U;
  }
  CHECK(parted > 50);
}

}  // namespace graze::tests
