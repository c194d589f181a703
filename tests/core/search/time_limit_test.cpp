// A query that runs out of time says what holds, and leaves nothing behind that shows in a later answer.

#include <array>
#include <chrono>
#include <limits>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;
using oracle::Shape;

/// Bends a body in each step, and carries b through a.
void move_to(Surface& a, Surface& b, const Shape& rest, std::uint64_t step) {
  REQUIRE(a.set_positions(wobbled(rest, 0.01, step).positions).taken());
  const double away = 0.05 * static_cast<double>(step % 8);
  REQUIRE(b.set_positions(mapped(wobbled(rest, 0.01, step + 50), 1.01, {away, 0, 0}).positions).taken());
  for (Surface* const surface : {&a, &b}) {
    surface->refit_faces();
    surface->refit_vertices();
    surface->make_blocks();
  }
}

/// Checks an answer that was cut short by a time limit against the whole answer.
void check_cut_short(const PairAnswer& cut, const PairAnswer& whole) {
  CHECK(cut.contacts.empty());
  CHECK_FALSE(cut.in_contact);
  CHECK(cut.listed);
  CHECK(cut.distance.lower <= whole.distance.lower);
  CHECK(cut.distance.upper >= whole.distance.upper);
  CHECK((cut.witness.point_b - cut.witness.point_a).norm() == Approx(cut.distance.upper).epsilon(1e-12));
}

/// Queries that end at deadlines of up to as long as a whole one takes, whole ones in between.
template <typename Detect>
std::size_t count_cut_short(ContactDetail detail, const Shape& rest, const Detect& detect_with) {
  const FloatingPointScope scope;
  Surface a = surface_of(rest);
  Surface b = surface_of(rest);
  LeafFront front;
  std::size_t cut = 0;
  Random random(7);
  for (std::uint64_t step = 0; step < 24; ++step) {
    move_to(a, b, rest, step);
    PairQuery query = query_of(detail, 0.1);
    query.slack = step % 4 < 2 ? 0.02 : 0;
    query.list_slack = step % 4 < 3 ? 0.02 : 0;
    const auto start = std::chrono::steady_clock::now();
    const PairAnswer whole = detect(a, b, query);
    const auto taken = std::chrono::steady_clock::now() - start;
    INFO("detail " << static_cast<int>(detail) << ", step " << step);
    if (step % 3 != 2) {
      const double share = step % 8 == 0 ? 0 : random.between(0, 1);
      query.deadline = std::chrono::steady_clock::now() +
                       std::chrono::duration_cast<std::chrono::nanoseconds>(share * taken);
    }
    const PairAnswer answer = detect_with(a, b, query, front);
    CHECK((answer.complete || query.deadline != PairQuery::no_deadline));
    if (answer.complete) {
      tests::check_same(answer, whole);
    } else {
      check_cut_short(answer, whole);
      ++cut;
    }
  }
  return cut;
}

}  // namespace

TEST_CASE("time limit: a query that was cut short does not show in the next answers") {
  const Shape ball = shape_of(models::sphere(24, 15));
  for (const ContactDetail detail : all_details) {
    PairDetector detector;
    const std::size_t cut = count_cut_short(
        detail, ball, [&](const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front) {
          PairAnswer answer;
          PairCounters counters;
          detector.detect(a, b, query, front, answer, counters);
          return answer;
        });
    CHECK(cut >= 2);  // where no time was left from the start
  }
}

TEST_CASE("time limit: nor does one of a pair that is cut into slices") {
  const Shape ball = shape_of(models::sphere(48, 31));
  for (const ContactDetail detail : all_details) {
    std::array<PairDetector, 2> detectors;
    LargePair large;
    const std::size_t cut = count_cut_short(
        detail, ball, [&](const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front) {
          PairAnswer answer;
          PairCounters counters;
          large.begin(a, b, query, front, answer);
          while (!large.advance(detectors[0], counters))
            for (std::size_t slice = 0; slice < large.slice_count(); ++slice)
              large.run_slice(slice, detectors[slice % 2], counters);
          return answer;
        });
    CHECK(cut >= 2);
  }
}

TEST_CASE("time limit: a query that takes long ends soon after its deadline") {
  const FloatingPointScope scope;
  // In one place, so that all that is near is tied at distance 0.
  const Shape ball = shape_of(models::sphere(60, 40));
  const Surface a = surface_of(ball);
  const Surface b = surface_of(ball);
  for (const ContactDetail detail : {ContactDetail::closest, ContactDetail::features}) {
    PairQuery query = query_of(detail, 0.5);
    const auto start = std::chrono::steady_clock::now();
    query.deadline = start + std::chrono::milliseconds(5);
    const PairAnswer answer = detect(a, b, query);
    const auto taken = std::chrono::steady_clock::now() - start;
    CHECK_FALSE(answer.complete);
    CHECK(taken < std::chrono::milliseconds(250));  // whole it takes several times that, on any machine
  }
}

}  // namespace graze::tests
