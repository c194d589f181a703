// AccuracyMode::within: bounds hold and are no looser than asked, contacts are exact, and there is less work.

#include <array>
#include <graze/accuracy.hpp>
#include <graze/error.hpp>
#include <iostream>
#include <limits>

#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Shape;

PairQuery within(ContactDetail detail, double threshold, double tolerance) {
  PairQuery query = query_of(detail, threshold);
  query.mode = AccuracyMode::within;
  query.tolerance = tolerance;
  return query;
}

void check_answer(const PairAnswer& answer, const PairAnswer& exact, double tolerance) {
  CHECK(answer.in_contact == exact.in_contact);
  CHECK(answer.listed);
  CHECK(text_of(answer.contacts) == text_of(exact.contacts));
  CHECK(answer.distance.lower <= exact.distance.lower);
  CHECK(answer.distance.upper >= exact.distance.upper);
  // Both bounds are rounded, so they are neighbouring doubles at least.
  const double rounding = answer.distance.upper * 0x1p-40;
  if (!answer.in_contact) CHECK(answer.distance.upper - answer.distance.lower <= tolerance + rounding);
}

PairCounters work_of(const Surface& a, const Surface& b, const PairQuery& query) {
  PairDetector detector;
  PairAnswer answer;
  PairCounters counters;
  detector.detect(a, b, query, answer, counters);
  return counters;
}

}  // namespace

TEST_CASE("within: random scenes") {
  std::size_t loose = 0;
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Surface a = surface_of(scene.a);
    const Surface b = surface_of(scene.b);
    const oracle::Pair surfaces = oracle::surface_distance(scene.a, scene.b);
    const oracle::Pair vertices = oracle::vertex_distance(scene.a, scene.b);
    for (const ContactDetail detail : all_details) {
      const PairAnswer exact = detect(a, b, query_of(detail, scene.threshold));
      const oracle::Pair& truth = is_about_vertices(detail) ? vertices : surfaces;
      for (const double tolerance : {0.0, 0.1, 2.0}) {
        INFO("seed " << seed << ", detail " << static_cast<int>(detail) << ", tolerance " << tolerance);
        const PairAnswer answer = detect(a, b, within(detail, scene.threshold, tolerance));
        check_answer(answer, exact, tolerance);
        CHECK(answer.distance.lower <= truth.distance_down);
        CHECK(answer.distance.upper >= truth.distance_up);
        loose += answer.distance.upper > answer.distance.lower ? 1 : 0;
        ++compared;
      }
    }
  }
  CHECK(loose > 100);
  std::cout << "compared " << compared << " answers within a tolerance, " << loose << " of them loose\n";
}

TEST_CASE("within: large near surfaces take less work the looser they may be") {
  const Shape ball = shape_of(models::sphere(60, 40));
  const Surface a = surface_of(ball);
  const Surface b = surface_of(placed_beside(turned(ball, 1), ball, 0, 0.2));
  for (const ContactDetail detail : all_details) {
    const PairAnswer exact = detect(a, b, query_of(detail, 0.01));
    const PairCounters exact_work = work_of(a, b, query_of(detail, 0.01));
    REQUIRE_FALSE(exact.in_contact);
    std::uint64_t before = exact_work.leaf_pairs_tested;
    for (const double tolerance : {0.01, 0.1, 0.5}) {
      INFO("detail " << static_cast<int>(detail) << ", tolerance " << tolerance);
      check_answer(detect(a, b, within(detail, 0.01, tolerance)), exact, tolerance);
      const PairCounters work = work_of(a, b, within(detail, 0.01, tolerance));
      CHECK(work.region_pairs_tested <= exact_work.region_pairs_tested);
      CHECK(work.leaf_pairs_tested <= before);
      before = work.leaf_pairs_tested;
      if (tolerance == 0.5) CHECK(work.region_pairs_tested <= exact_work.region_pairs_tested * 2 / 3);
      std::cout << "within " << tolerance << ", detail " << static_cast<int>(detail) << ": "
                << work.region_pairs_tested << " region pairs, exact " << exact_work.region_pairs_tested
                << "\n";
    }
  }
}

TEST_CASE("within: contacts are exact however loose") {
  const Shape ball = shape_of(models::sphere(14, 9));
  const Surface a = surface_of(ball);
  std::size_t contacts = 0;
  for (const double gap : {-0.2, 0.02, 0.1}) {
    const Surface b = surface_of(placed_beside(turned(ball, 1), ball, 0, gap));
    for (const ContactDetail detail : all_details) {
      const double threshold = detect(a, b, query_of(detail, 0)).distance.upper + 0.05;
      const PairAnswer exact = detect(a, b, query_of(detail, threshold));
      check_answer(detect(a, b, within(detail, threshold, 10)), exact, 10);
      CHECK(exact.in_contact);
      contacts += exact.contacts.size();
    }
  }
  CHECK(contacts > 50);
}

TEST_CASE("accuracy: what it holds, and what it refuses") {
  CHECK(Accuracy::exact().mode() == AccuracyMode::exact);
  CHECK(Accuracy::within(0.25).mode() == AccuracyMode::within);
  CHECK(Accuracy::within(0.25).tolerance() == 0.25);
  CHECK(Accuracy::paper().mode() == AccuracyMode::paper);
  CHECK(Accuracy::paper().epsilon().empty());
  CHECK(Accuracy::paper({3, 2, 1}).epsilon() == std::vector<double>{3, 2, 1});
  for (const double bad :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(Accuracy::within(bad), Error);
    CHECK_THROWS_AS(Accuracy::paper({1, bad}), Error);
  }
}

TEST_CASE("budget: a spent work limit leaves outer bounds, an ample one the answer") {
  const Shape ball = shape_of(models::sphere(14, 9));
  const Surface a = surface_of(ball);
  const Surface b = surface_of(placed_beside(turned(ball, 1), ball, 0, 0.02));
  for (const ContactDetail detail : all_details) {
    INFO("detail " << static_cast<int>(detail));
    PairQuery query = query_of(detail, 0.05);
    const PairAnswer exact = detect(a, b, query);
    query.work_limit = 3;
    const PairAnswer spent = detect(a, b, query);
    CHECK_FALSE(spent.complete);
    CHECK(spent.contacts.empty());
    CHECK(spent.distance.lower <= exact.distance.lower);
    CHECK(spent.distance.upper >= exact.distance.upper);
    CHECK(work_of(a, b, query).region_pairs_tested == 3);
    query.work_limit = 1'000'000;
    const PairAnswer ample = detect(a, b, query);
    CHECK(ample.complete);
    CHECK(text_of(ample.contacts) == text_of(exact.contacts));
  }
}

}  // namespace graze::tests
