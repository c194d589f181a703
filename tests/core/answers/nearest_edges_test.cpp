// The pairs of edges that detail `nearest` lists, and which of them are sunk, against brute force in exact
// arithmetic: random pairs with many creases, from scratch, over steps, in slices, with groups, and at the
// limits of the rule.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/pair/group_filter.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/edge_comparison.hpp"
#include "support/effort.hpp"
#include "support/random/random_creases.hpp"
#include "support/reduce.hpp"

namespace graze::tests {
namespace {

using oracle::Creases;
using oracle::CreaseScene;
using oracle::FacePairs;
using oracle::Random;
using oracle::Shape;

constexpr std::uint64_t edge_part_count = 4;
constexpr std::uint64_t edge_scenes = repeats(5'000) / edge_part_count;
constexpr std::uint64_t edge_plays = repeats(100);

/// Two groups on each side, of which some are ignored against each other, or none.
class RandomGroups {
 public:
  RandomGroups(const CreaseScene& scene, Random& random, double chance) {
    if (!random.chance(chance)) return;
    for (std::size_t i = 0; i < scene.a.faces.size(); ++i) a_.push_back(group(random));
    for (std::size_t i = 0; i < scene.b.faces.size(); ++i) b_.push_back(group(random));
    for (std::uint8_t group_a = 0; group_a < 2; ++group_a)
      for (std::uint8_t group_b = 0; group_b < 2; ++group_b)
        if (random.chance(0.3)) ignored_.emplace_back(group_a, group_b);
    const auto are_looked_at = [this](std::uint32_t face_a, std::uint32_t face_b) {
      return std::find(ignored_.begin(), ignored_.end(), std::pair(a_[face_a], b_[face_b])) == ignored_.end();
    };
    pairs_ = FacePairs(scene.a, scene.b, are_looked_at);
  }

  [[nodiscard]] const FacePairs& pairs() const { return pairs_; }
  /// The filter of the library, or none where all faces are tested.
  [[nodiscard]] std::optional<GroupFilter> filter(const Surface& a, const Surface& b) const {
    if (a_.empty()) return std::nullopt;
    GroupFilter made(std::make_shared<const FaceGroups>(a.mesh(), a_),
                     std::make_shared<const FaceGroups>(b.mesh(), b_));
    for (const auto& [group_a, group_b] : ignored_) made.set_ignored(group_a, group_b, true);
    return made;
  }

 private:
  static std::uint8_t group(Random& random) { return random.chance(0.7) ? 0 : 1; }

  std::vector<std::uint8_t> a_, b_;
  std::vector<std::pair<std::uint8_t, std::uint8_t>> ignored_;
  FacePairs pairs_;
};

std::string text_of_scene(const CreaseScene& scene) {
  return "threshold " + std::to_string(scene.threshold) + "\nat rest: a " + text_of(scene.rest_a) + "b " +
         text_of(scene.rest_b) + "now: a " + text_of(scene.a) + "b " + text_of(scene.b);
}

/// How the edges of a scene differ from brute force in `nearest` and in `features`.
std::string fault_of(const CreaseScene& scene, const RandomGroups& groups, EdgeTally* tally = nullptr) {
  if (!groups.pairs().are_some()) return {};
  const auto expected =
      edge_pairs_of(scene.a, scene.b, scene.threshold, Creases(scene.rest_a, scene.rest_b), groups.pairs());
  if (tally != nullptr) tally->count(expected);
  const Surface a = surface_of({scene.rest_a, scene.a});
  const Surface b = surface_of({scene.rest_b, scene.b});
  const auto filter = groups.filter(a, b);
  std::string text;
  for (const ContactDetail detail : {ContactDetail::nearest, ContactDetail::features}) {
    PairQuery query = query_of(detail, scene.threshold);
    query.groups = filter ? &*filter : nullptr;
    const PairAnswer answer = detect(a, b, query);
    const std::string difference = edge_difference(detail, answer.contacts, expected, {scene.a, scene.b});
    if (!difference.empty())
      text += (detail == ContactDetail::nearest ? "nearest: " : "features: ") + difference;
  }
  return text;
}

/// Compares the scene of a seed. One that differs is reduced, if all of it is at rest.
void check_edges(std::uint64_t seed, EdgeTally& tally) {
  const CreaseScene scene = oracle::random_creases(seed);
  Random random(seed + 3);
  const RandomGroups groups(scene, random, 0.25);
  const std::string fault = fault_of(scene, groups, &tally);
  if (fault.empty()) return;
  const auto at_rest = [&](const TwoShapes& shapes) {
    const CreaseScene smaller{shapes.a, shapes.b, shapes.a, shapes.b, shapes.threshold};
    Random none(0);
    return fault_of(smaller, RandomGroups(smaller, none, 0));
  };
  const TwoShapes shapes{scene.a, scene.b, scene.threshold};
  const bool is_at_rest = !at_rest(shapes).empty();
  FAIL_CHECK("seed " << seed << ", lie " << static_cast<int>(scene.lie) << ": " << fault
                     << (is_at_rest ? "reduced:\n" + reduced_text(shapes, at_rest) : text_of_scene(scene)));
}

/// Plays a scene that moves a little in each step, with one front and list, and compares each answer.
void check_steps(std::uint64_t seed, EdgeTally& tally, std::uint64_t& by_list) {
  CreaseScene scene = oracle::random_creases(seed);
  Random random(seed + 5);
  const RandomGroups groups(scene, random, 0.25);
  if (!groups.pairs().are_some()) return;
  const Creases creases(scene.rest_a, scene.rest_b);
  Surface a = surface_of({scene.rest_a, scene.a});
  Surface b = surface_of({scene.rest_b, scene.b});
  const auto filter = groups.filter(a, b);
  PairQuery query =
      query_of(seed % 3 == 0 ? ContactDetail::features : ContactDetail::nearest, scene.threshold);
  query.groups = filter ? &*filter : nullptr;
  query.reach = 2 * scene.threshold;
  query.slack = query.leaf_test_slack = query.list_slack = scene.threshold;
  PairDetector detector;
  LeafFront front;
  PairAnswer answer;
  PairCounters counters;
  for (int step = 0; step < 6; ++step) {
    if (step > 0) oracle::move_a_little(scene, random);
    REQUIRE(a.set_positions(scene.a.positions).taken());
    REQUIRE(b.set_positions(scene.b.positions).taken());
    detector.detect(a, b, query, front, answer, counters);
    const auto expected = edge_pairs_of(scene.a, scene.b, scene.threshold, creases, groups.pairs());
    tally.count(expected);
    INFO("seed " << seed << ", step " << step);
    REQUIRE(edge_difference(query.detail, answer.contacts, expected, {scene.a, scene.b}) == "");
  }
  by_list += counters.pairs_by_list;
}

/// A query by slices in an order of its own, by several detectors.
PairAnswer sliced_answer(const Surface& a, const Surface& b, const PairQuery& query, Random& random) {
  LargePair large;
  LeafFront front;
  PairAnswer answer;
  std::array<PairDetector, 3> detectors;
  PairCounters counters;
  std::size_t slices = 0;
  large.begin(a, b, query, front, answer);
  while (!large.advance(detectors[random.below(3)], counters)) {
    std::vector<std::size_t> order(large.slice_count());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    for (const std::size_t slice : order) large.run_slice(slice, detectors[random.below(3)], counters);
    slices += order.size();
  }
  CHECK(slices > 1);
  return answer;
}

/// A ball of which each vertex is a little nearer to the middle or further away: all of its edges are bent.
Shape rough_ball(std::uint64_t seed, double roughness) {
  Random random(seed);
  Shape shape = shape_of(models::sphere(96, 48));
  for (Eigen::Vector3d& position : shape.positions) position *= 1 + random.between(-roughness, roughness);
  return shape;
}

double ulps_from(double value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafter(value, 2);
  for (; ulps < 0; ++ulps) value = std::nextafter(value, -2);
  return value;
}

/// Two triangles that share edge 0, from (-1, 0, 0) to (1, 0, 0). Their corners are at ±1 along y, and as
/// high as given.
Shape roof(double height_before, double height_behind) {
  return {{{-1, 0, 0}, {1, 0, 0}, {0, -1, height_before}, {0, 1, height_behind}}, {{0, 1, 3}, {1, 0, 2}}};
}

/// A triangle with edge 0 along y over the origin, and a corner far above.
Shape bar_over(double height) {
  return {{{0, -1, height}, {0, 1, height}, {0, 0, 30}}, {{0, 1, 2}}};
}

bool lists_first_edges(const Shape& rest, const Shape& now, const Shape& bar) {
  const PairAnswer answer =
      detect(surface_of({rest, now}), surface_of(bar), query_of(ContactDetail::nearest, 0.3));
  return std::any_of(answer.contacts.begin(), answer.contacts.end(), [](const Contact& contact) {
    return contact.kind == ContactKind::EE && contact.feature_a.index == 0 && contact.feature_b.index == 0;
  });
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("edges of nearest: random surfaces with creases are those of brute force, part", "",
                       ((int part), part), 0, 1, 2, 3) {
  const FloatingPointScope scope;
  EdgeTally tally;
  for (std::uint64_t i = 0; i < edge_scenes; ++i) check_edges(part * edge_scenes + i, tally);
  CHECK(tally.judged > 20 * edge_scenes);
  CHECK(tally.locally_closest > edge_scenes);
  CHECK(tally.patches_only > edge_scenes / 2);
  CHECK(tally.sunk > edge_scenes / 2);
  CHECK(tally.sunk_and_listed > edge_scenes / 10);
  CHECK(tally.behind_only > edge_scenes);
  CHECK(tally.crossing >= edge_scenes / 250);  // rare: a few hundred scenes have none
  tally.print("scenes of one step");
}

TEST_CASE("edges of nearest: fronts and near lists do not change them from step to step") {
  const FloatingPointScope scope;
  EdgeTally tally;
  std::uint64_t by_list = 0;
  for (std::uint64_t i = 0; i < edge_plays; ++i) check_steps(1'000'000 + i, tally, by_list);
  CHECK(by_list > edge_plays);
  CHECK(tally.patches_only > edge_plays);
  CHECK(tally.sunk_and_listed >= edge_plays / 20);
  tally.print("scenes of six steps");
}

TEST_CASE("edges of nearest: slices of a large pair list those of brute force") {
  const FloatingPointScope scope;
  Random random(11);
  EdgeTally tally;
  const Shape ball = rough_ball(1, 0.01);
  const Shape other = turned(rough_ball(2, 0.01), 3);
  for (const double apart : {1.99, 1.95}) {
    const Shape moved = mapped(other, 1, {apart, 0, 0});
    const auto expected = edge_pairs_of(ball, moved, 0.03, Creases(ball, other));
    tally.count(expected);
    const Surface a = surface_of(ball);
    const Surface b = surface_of({other, moved});
    for (const ContactDetail detail : {ContactDetail::nearest, ContactDetail::features}) {
      const PairAnswer answer = sliced_answer(a, b, query_of(detail, 0.03), random);
      CHECK(edge_difference(detail, answer.contacts, expected, {ball, moved}) == "");
      check_same(answer, detect(a, b, query_of(detail, 0.03)));
    }
  }
  CHECK(tally.patches_only > 50);
  CHECK(tally.sunk_and_listed > 10);
  tally.print("large pairs");
}

TEST_CASE("edges of nearest: an edge is a crease from a bend on, to the last bit") {
  // One side of the roof is flat at rest, the other bent down by the limit of a crease: 1 / sqrt(127).
  const double limit = std::sqrt(1.0 / 127);
  const Shape bar = bar_over(0.25);
  // The roof has become a shallow valley: only a crease is listed there.
  const Shape valley = roof(0.05, 0.05);
  std::size_t creases = 0;
  for (int ulps = -4; ulps <= 4; ++ulps)
    for (const double sign : {-1.0, 1.0}) {
      const Shape rest = roof(0, sign * ulps_from(limit, ulps));
      const bool is_crease = oracle::creases_of(rest)[0];
      CHECK(is_crease == (oracle::Rational(rest.positions[3].z()) * rest.positions[3].z() * 127 > 1));
      CHECK(lists_first_edges(rest, valley, bar) == is_crease);
      creases += is_crease ? 1U : 0U;
    }
  CHECK((creases > 3 && creases < 15));
  // Nothing else counts than the shape at rest.
  CHECK_FALSE(lists_first_edges(roof(0, 0), roof(0.1, 0.1), bar));
  CHECK(lists_first_edges(roof(0.5, 0.5), roof(0.05, 0.05), bar));
  CHECK(lists_first_edges(roof(0, 0), roof(-0.1, -0.1), bar));  // locally closest
  CHECK_FALSE(lists_first_edges(roof(0, 0), roof(0, 0), bar));  // flat, seen exactly from above
}

TEST_CASE("edges of nearest: a valley bounds a patch up to an angle, to the last bit") {
  const double limit = std::sqrt(1.0 / 31);  // the height of a corner whose sine is the root of 1/32
  const Shape rest = roof(1, 1);
  const Shape bar = bar_over(0.25);
  std::size_t listed = 0;
  for (int ulps = -4; ulps <= 4; ++ulps) {
    const double height = ulps_from(limit, ulps);
    const bool is_within = oracle::Rational(height) * height * 31 <= 1;
    CHECK(lists_first_edges(rest, roof(height, 0), bar) == is_within);
    CHECK(lists_first_edges(rest, roof(-1, height), bar) == is_within);
    listed += is_within ? 1U : 0U;
  }
  CHECK((listed > 1 && listed < 8));
}

TEST_CASE("edges of nearest: both sides back are not sunk unless an edge pierces") {
  // Two plates that lie on each other, crosswise. The upper edges of the lower one and the lower edges of the
  // upper one have their own plates between them.
  const Shape plate = box({-0.4, -0.2, -0.005}, {0.8, 0.4, 0.01});
  const Shape upper = oracle::turned_about(plate, Eigen::Vector3d::UnitZ(), 1.3);
  for (const double height : {0.015, 0.006}) {
    const Shape moved = mapped(upper, 1, {0, 0, height});
    const auto expected = edge_pairs_of(plate, moved, 0.05, Creases(plate, upper));
    EdgeTally tally;
    tally.count(expected);
    const bool is_apart = height > 0.01;
    CHECK((tally.sunk == 0) == is_apart);
    CHECK((tally.behind_only > 0 || !is_apart));
    for (const ContactDetail detail : {ContactDetail::nearest, ContactDetail::features}) {
      const PairAnswer answer = detect(surface_of(plate), surface_of({upper, moved}), query_of(detail, 0.05));
      CHECK(edge_difference(detail, answer.contacts, expected, {plate, moved}) == "");
    }
  }
}

}  // namespace graze::tests
