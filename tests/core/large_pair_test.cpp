// A pair that is cut into slices has the answer of one that is not, whoever runs the slices.

#include <array>
#include <graze/floating_point_scope.hpp>
#include <graze/large_pair.hpp>
#include <iostream>
#include <limits>
#include <numeric>

#include "core/comparison.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/random_scenes.hpp"

namespace graze::tests {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Answers a query by slices run out of order by several detectors.
class SlicedQueries {
 public:
  const PairAnswer& detect(const Surface& a, const Surface& b, const PairQuery& query, std::uint64_t seed) {
    oracle::Random random(seed);
    large_.begin(a, b, query, front_, answer_);
    while (!large_.advance(detectors_[random.below(3)], counters_)) {
      CHECK(large_.slice_count() > 1);
      std::vector<std::size_t> order(large_.slice_count());
      std::iota(order.begin(), order.end(), 0);
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
      for (const std::size_t slice : order) large_.run_slice(slice, detectors_[random.below(3)], counters_);
      ++rounds;
      slices += order.size();
    }
    return answer_;
  }

  std::size_t rounds = 0;
  std::size_t slices = 0;

 private:
  LargePair large_;
  LeafFront front_;
  PairAnswer answer_;
  std::array<PairDetector, 3> detectors_;
  PairCounters counters_;
};

/// The regions' bounds are made anew in some frames only.
void move_to(Surface& surface, const oracle::Shape& shape, bool refits) {
  REQUIRE(surface.set_positions(shape.positions).taken());
  if (!refits) return;
  surface.refit_vertices();
  surface.refit_faces();
}

void check_same(const PairAnswer& answer, const PairAnswer& whole) {
  CHECK(answer.complete == whole.complete);
  CHECK(answer.in_contact == whole.in_contact);
  REQUIRE(answer.listed == whole.listed);
  if (!answer.listed) return;
  CHECK(answer.distance.lower == whole.distance.lower);
  CHECK(answer.distance.upper == whole.distance.upper);
  CHECK(answer.witness.feature_a == whole.witness.feature_a);
  CHECK(answer.witness.feature_b == whole.witness.feature_b);
  CHECK(text_of(answer.contacts) == text_of(whole.contacts));
}

struct Motion {
  const char* name;
  oracle::Shape a;
  oracle::Shape b;
  double gap;    ///< b's way towards a in the first frame
  double speed;  ///< and in each later one
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("large pair: slices give the answer of the whole, detail", "", ((int number), number),
                       0, 1, 2, 3, 4) {
  const FloatingPointScope scope;
  const auto detail = static_cast<ContactDetail>(number);
  const oracle::Shape ball = shape_of(models::sphere(120, 80));
  const std::array motions{
      // Shells that lie in each other, near everywhere: more than enough for every stage to be cut.
      Motion{"shells", ball, mapped(ball, 1.03, {0, 0, 0}), 0, 0.002},
      Motion{"side by side", ball, turned(mapped(ball, 1, {0, 0, 0}), 3), 2.01, -0.01},
      Motion{"tori through each other", shape_of(models::torus(120, 60, 0.8, 0.3)),
             turned(shape_of(models::torus(120, 60, 0.8, 0.3)), 5), 0.4, 0.03},
  };
  std::size_t compared = 0;
  std::size_t contacts = 0;
  SlicedQueries sliced;
  for (const Motion& motion : motions) {
    INFO(motion.name);
    Surface a = surface_of(motion.a);
    Surface b = surface_of(motion.b);
    sliced = {};
    PairDetector detector;
    LeafFront front;
    for (int frame = 0; frame < 5; ++frame) {
      const auto seed = static_cast<std::uint64_t>(frame);
      move_to(a, wobbled(motion.a, 0.004, seed), frame == 3);
      move_to(b, mapped(wobbled(motion.b, 0.004, seed + 9), 1, {motion.gap + frame * motion.speed, 0, 0}),
              frame == 2);
      PairQuery query = query_of(detail, 0.02);
      query.reach = frame % 2 == 0 ? infinity : 0.05;
      query.slack = 0.01;
      if (frame == 4) {
        query.mode = AccuracyMode::within;
        query.tolerance = 0.01;
      }
      INFO("frame " << frame);
      PairAnswer whole;
      PairCounters counters;
      detector.detect(a, b, query, front, whole, counters);
      const PairAnswer& answer = sliced.detect(a, b, query, seed);
      if (query.mode == AccuracyMode::exact || whole.in_contact) check_same(answer, whole);
      CHECK(answer.distance.lower <= whole.distance.upper);
      CHECK(answer.distance.upper >= whole.distance.lower);
      ++compared;
      contacts += whole.contacts.size();
    }
    CHECK(sliced.rounds >= 1);
  }
  std::cout << "compared " << compared << " answers, " << contacts << " contacts\n";
}

}  // namespace graze::tests
