// A pair that is cut into slices has the answer of one that is not, whoever runs the slices.

#include "core/search/large_pair.hpp"

#include <array>
#include <iostream>
#include <limits>
#include <numeric>
#include <span>
#include <sstream>
#include <string>

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
#include "support/random/random_scenes.hpp"

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
  surface.make_blocks();
  if (!refits) return;
  surface.refit_vertices();
  surface.refit(RefitOf::radii);
  surface.refit_faces();
}

/// Everything that is said of the regions, bit for bit.
std::string text_of(std::span<const RegionDistance> distances) {
  std::ostringstream text;
  text << std::hexfloat;
  for (const RegionDistance& line : distances)
    text << line.level << ' ' << line.region_a << ' ' << line.region_b << ' ' << line.vertex_a << ' '
         << line.vertex_b << ' ' << line.point_a.transpose() << ' ' << line.point_b.transpose() << ' '
         << line.distance << '\n';
  return text.str();
}

struct Motion {
  const char* name;
  oracle::Shape a;
  oracle::Shape b;
  double gap;    ///< b's way towards a in the first frame
  double speed;  ///< and in each later one
};

}  // namespace

static_assert(all_details.size() == 6, "add the number of a new detail to each list of numbers here");

TEMPLATE_TEST_CASE_SIG("large pair: slices give the answer of the whole, detail", "", ((int number), number),
                       0, 1, 2, 3, 4, 5) {
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
    // Vertices of surfaces that meet in one place are found in one piece.
    const bool is_swept = detail == ContactDetail::vertices && &motion == &motions[1];
    CHECK((is_swept || sliced.rounds >= 1));
  }
  std::cout << "compared " << compared << " answers, " << contacts << " contacts\n";
}

TEST_CASE("large pair: slices list the distances of regions that one walk lists, capped or not") {
  const FloatingPointScope scope;
  const oracle::Shape ball = shape_of(models::sphere(120, 80));
  Surface a = surface_of(ball);
  Surface b = surface_of(mapped(ball, 1.03, {0.01, 0.02, 0}));
  move_to(a, ball, true);
  move_to(b, mapped(ball, 1.03, {0.01, 0.02, 0}), true);
  const std::array epsilon{0.9, 0.5, 0.3};
  PairDetector detector;
  std::size_t listed = 0;
  for (const AccuracyMode mode : {AccuracyMode::exact, AccuracyMode::paper})
    for (const ContactDetail detail : {ContactDetail::none, ContactDetail::vertices}) {
      if (mode == AccuracyMode::paper && detail == ContactDetail::none) continue;
      PairQuery query = query_of(detail, 0.02);
      query.reach = query.region_distance_reach = 0.05;
      query.mode = mode;
      if (mode == AccuracyMode::paper) query.epsilon = epsilon;
      query.region_distance_limit = std::numeric_limits<std::size_t>::max();
      PairAnswer whole;
      detector.region_distances(a, b, query, whole);
      const std::size_t count = whole.region_distances.size();
      REQUIRE(count > 1000);
      CHECK(whole.region_distances_left_out == 0);
      listed += count;
      for (const std::size_t limit :
           {count, count - 1, count / 2, count / 9, std::size_t{70}, std::size_t{1}}) {
        INFO("mode " << static_cast<int>(mode) << ", detail " << static_cast<int>(detail) << ", limit "
                     << limit);
        query.region_distance_limit = limit;
        PairAnswer capped;
        detector.region_distances(a, b, query, capped);
        SlicedQueries sliced;
        const PairAnswer& answer = sliced.detect(a, b, query, limit);
        CHECK(capped.region_distances.size() == limit);
        CHECK((capped.region_distances_left_out > 0) == (limit < count));
        CHECK(answer.region_distances_left_out == capped.region_distances_left_out);
        CHECK(text_of(answer.region_distances) == text_of(capped.region_distances));
        CHECK(text_of(answer.region_distances) ==
              text_of(std::span<const RegionDistance>(whole.region_distances).first(limit)));
        query.region_distance_limit = 0;
        SlicedQueries without;
        CHECK(without.detect(a, b, query, limit).region_distances.empty());
        // The walk has rounds of its own, the deepest of which has many slices.
        if (limit > count / 3) {
          CHECK(sliced.rounds > without.rounds);
          CHECK(sliced.slices > without.slices + 10);
        }
      }
    }
  std::cout << "compared " << listed << " distances of regions\n";
}

}  // namespace graze::tests
