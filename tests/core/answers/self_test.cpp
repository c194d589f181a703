// A surface with itself against brute force over all pairs of its features: every detail, from nothing and
// with what earlier queries left, and in slices.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/pair/group_filter.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/self_exclusion.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
#include "core/search/rest_gaps.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "support/oracle/self_pairs.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;
using oracle::Shape;

/// A surface with what is asked about it and itself.
struct SelfScene {
  Body body;
  double threshold = 0;
  std::uint32_t rings = 1;
  bool at_rest = false;

  [[nodiscard]] double rest_distance() const { return at_rest ? 0 : threshold; }
  [[nodiscard]] bool has_quads() const {
    return std::any_of(body.rest.faces.begin(), body.rest.faces.end(),
                       [](const auto& corners) { return corners.size() == 4; });
  }
};

constexpr bool is_of_self(ContactDetail detail) {
  return detail != ContactDetail::regions;
}

SelfQuery self_query(const SelfScene& scene, const SelfExclusion& exclusion, ContactDetail detail) {
  return {&exclusion, scene.rest_distance(), is_about_vertices(detail)};
}

/// The two shapes of a scene as one surface, which at rest are further from each other.
SelfScene scene_of_two(std::uint64_t seed) {
  const oracle::RandomScene two = oracle::random_scene(seed);
  Random random(seed);
  Shape rest = two.a;
  Shape now = two.a;
  const auto offset = static_cast<std::uint32_t>(two.a.positions.size());
  const Eigen::Vector3d away(random.chance(0.5) ? 0 : 0.5, 0, 0);
  for (const Eigen::Vector3d& position : two.b.positions) {
    rest.positions.emplace_back(position + away);
    now.positions.push_back(position);
  }
  for (std::vector<std::uint32_t> face : two.b.faces) {
    for (std::uint32_t& corner : face) corner += offset;
    rest.faces.push_back(face);
    now.faces.push_back(face);
  }
  const std::uint32_t rings = random.below(3);
  return {{rest, now}, two.threshold, rings, random.chance(0.5)};
}

/// A flat sheet at rest of triangles, or of quads, some of them missing.
Shape sheet(std::uint32_t columns, std::uint32_t rows, bool of_quads) {
  Shape shape;
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t column = 0; column <= columns; ++column) shape.positions.emplace_back(column, row, 0);
  const auto at = [&](std::uint32_t column, std::uint32_t row) { return row * (columns + 1) + column; };
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::vector<std::uint32_t> corners{at(column, row), at(column + 1, row), at(column + 1, row + 1),
                                               at(column, row + 1)};
      if (of_quads) {
        shape.faces.push_back(corners);
      } else {
        shape.faces.push_back({corners[0], corners[1], corners[2]});
        shape.faces.push_back({corners[0], corners[2], corners[3]});
      }
    }
  return shape;
}

/// Puts the faces into another order, so that the numbers of edges have nothing to do with where they are.
void shuffle_faces(Body& body, Random& random) {
  for (std::size_t i = body.rest.faces.size() - 1; i > 0; --i)
    std::swap(body.rest.faces[i], body.rest.faces[random.below(static_cast<std::uint32_t>(i + 1))]);
  body.now.faces = body.rest.faces;
}

/// A sheet that is folded once or twice so that layers pass each other, and crumpled by random motion.
SelfScene crumpled_sheet(std::uint64_t seed) {
  Random random(seed);
  const std::uint32_t columns = 3 + random.below(5);
  const std::uint32_t rows = 1 + random.below(4);
  Shape rest = sheet(columns, rows, random.chance(0.25));
  Shape now = rest;
  const bool on_grid = random.chance(0.4);
  const double fold = 1 + random.below(columns - 1);
  const double noise = random.chance(0.3) ? 0 : random.between(0, 0.6);
  const double gap = random.between(-0.2, 0.4);
  for (Eigen::Vector3d& position : now.positions) {
    if (position.x() > fold) {
      position.x() = 2 * fold - position.x();
      position.z() = gap;
    }
    position += random.vector(-noise, noise);
  }
  if (on_grid) now = snapped(now, 0.25);
  const std::uint32_t rings = random.below(3);
  const bool at_rest = random.chance(0.3);
  SelfScene scene{
      {rest, now}, on_grid ? 0.25 * (1 + random.below(5)) : random.between(0.1, 1.2), rings, at_rest};
  if (random.chance(0.5)) shuffle_faces(scene.body, random);
  return scene;
}

/// The one contact of detail `nearest` if it has no other: the nearest of `features`, and of equally near
/// ones the lowest. What leads nearer to it is not looked at.
std::vector<oracle::Named> nearest_alone(const SelfScene& scene, const oracle::FacePairs& pairs) {
  const Shape& now = scene.body.now;
  const auto all = oracle::each_once(oracle::features(now, now, scene.threshold, pairs));
  const auto nearest = std::min_element(all.begin(), all.end(), [](const auto& left, const auto& right) {
    return left.distance_squared < right.distance_squared;
  });
  return nearest == all.end() ? std::vector<oracle::Named>() : std::vector{*nearest};
}

/// Describes how an answer differs from brute force. Empty if it does not.
std::string difference_of(const SelfScene& scene, const oracle::FacePairs& pairs, ContactDetail detail,
                          const PairAnswer& answer) {
  const Shape& now = scene.body.now;
  Expected expected = expected_of(now, now, scene.threshold, detail, scene.body.rest, scene.body.rest, pairs);
  if (detail == ContactDetail::nearest && expected.contacts.empty() && !expected.distance.pierced)
    expected.contacts = nearest_alone(scene, pairs);
  expected.in_contact = expected.in_contact || !expected.contacts.empty();
  expected.contacts = oracle::each_once(expected.contacts);
  const Tolerance tolerance(now, now);
  std::string text = tests::difference_of(answer.contacts, expected.contacts, tolerance);
  if (answer.in_contact != expected.in_contact) text += "in contact or not is wrong\n";
  const bool is_somewhere = expected.distance.distance_up < std::numeric_limits<double>::max();
  if (answer.listed != is_somewhere) text += "listed or not is wrong\n";
  // `nearest` takes the distance from its contacts, of which none is on the fold of a quad.
  if (answer.listed && !(detail == ContactDetail::nearest && scene.has_quads()))
    text += tests::difference_of(answer.distance, answer.witness, expected.distance, tolerance);
  if (answer.listed && !(answer.witness.feature_a < answer.witness.feature_b))
    text += "the witness is not in order\n";
  return text;
}

struct SelfMet {
  std::size_t contacts = 0;
  std::size_t pierced = 0;
};

void check_self(std::uint64_t seed, const SelfScene& scene, SelfMet& met) {
  const oracle::SelfPairs self(scene.body.rest, scene.rings, scene.rest_distance());
  const oracle::FacePairs pairs = self.pairs();
  const Surface surface = surface_of(scene.body);
  const auto exclusion = make_self_exclusion(surface.shared_mesh(), scene.rings);
  for (const ContactDetail detail : all_details) {
    if (!is_of_self(detail) || (detail == ContactDetail::nearest && scene.has_quads())) continue;
    const FeatureFilter filter(FeatureFilter(nullptr, nullptr), self_query(scene, *exclusion, detail));
    PairQuery query = query_of(detail, scene.threshold);
    query.groups = &filter;
    const PairAnswer answer = detect(surface, surface, query);
    INFO("seed " << seed << ", detail " << static_cast<int>(detail) << ", rings " << scene.rings
                 << ", at rest " << scene.at_rest << ", threshold " << scene.threshold);
    REQUIRE(difference_of(scene, pairs, detail, answer) == "");
    met.contacts += answer.contacts.size();
    met.pierced += static_cast<std::size_t>(
        std::count_if(answer.contacts.begin(), answer.contacts.end(),
                      [](const Contact& contact) { return contact.kind == ContactKind::EF; }));
  }
}

/// A sheet of several leaves in a smooth wave, with a fold that comes near it. Most of it hardly bends.
SelfScene waving_sheet(std::uint64_t seed, double phase) {
  Random random(seed);
  SelfScene scene{sheet(14, 9, random.chance(0.5))};
  scene.threshold = random.between(0.05, 0.9);
  scene.at_rest = random.chance(0.5);
  const double height = random.between(0, 1.5);
  const double fold = random.chance(0.5) ? 9 : 20;
  const double gap = random.between(-0.1, 1.5 * scene.threshold);
  for (Eigen::Vector3d& position : scene.body.now.positions) {
    position.z() = height * std::sin(0.3 * position.x() + phase) * std::cos(0.2 * position.y());
    if (position.x() <= fold) continue;
    position.x() = 2 * fold - position.x() - 0.3;
    position.z() += gap;
  }
  return scene;
}

/// Waves a sheet a little in each step, and compares each answer of a search that remembers the last ones
/// with that of one which does not, whole and in slices.
void play_self(std::uint64_t seed, ContactDetail detail, SelfMet& met, std::size_t& by_list) {
  SelfScene scene = waving_sheet(seed, 0);
  Surface surface = surface_of(scene.body);
  const auto exclusion = make_self_exclusion(surface.shared_mesh(), scene.rings);
  const FeatureFilter filter(FeatureFilter(nullptr, nullptr), self_query(scene, *exclusion, detail));
  PairQuery query = query_of(detail, scene.threshold);
  query.groups = &filter;
  query.slack = query.leaf_test_slack = query.list_slack = 0.125;
  PairDetector detector;
  LeafFront front;
  PairAnswer answer;
  PairCounters counters;
  LargePair large;
  LeafFront front_of_slices;
  PairAnswer in_slices;
  for (int step = 0; step < 6; ++step) {
    REQUIRE(surface.set_positions(waving_sheet(seed, 0.02 * step).body.now.positions).taken());
    surface.make_blocks();
    if (step % 2 == 0) surface.refit_faces();
    detector.detect(surface, surface, query, front, answer, counters);
    PairQuery alone = query_of(detail, scene.threshold);
    alone.groups = &filter;
    INFO("seed " << seed << ", detail " << static_cast<int>(detail) << ", step " << step);
    check_same(answer, detect(surface, surface, alone));
    large.begin(surface, surface, query, front_of_slices, in_slices);
    while (!large.advance(detector, counters))
      for (std::size_t i = large.slice_count(); i-- > 0;) large.run_slice(i, detector, counters);
    check_same(in_slices, answer);
    met.contacts += answer.contacts.size();
  }
  by_list += counters.pairs_by_list;
}

}  // namespace

TEST_CASE("self: two random shapes as one surface are those of brute force") {
  const FloatingPointScope scope;
  SelfMet met;
  for (std::uint64_t seed = 1; seed <= repeats(160); ++seed) check_self(seed, scene_of_two(seed), met);
  CHECK(met.contacts > 10 * repeats(160));
  CHECK(met.pierced > repeats(160));
}

TEST_CASE("self: crumpled sheets are those of brute force") {
  const FloatingPointScope scope;
  SelfMet met;
  for (std::uint64_t seed = 1; seed <= repeats(160); ++seed) check_self(seed, crumpled_sheet(seed), met);
  CHECK(met.contacts > 10 * repeats(160));
  CHECK(met.pierced > repeats(160));
}

TEST_CASE("self: sheets of several leaves that hardly bend are those of brute force") {
  const FloatingPointScope scope;
  SelfMet met;
  for (std::uint64_t seed = 1; seed <= repeats(8); ++seed) check_self(seed, waving_sheet(seed, 0.5), met);
  CHECK(met.contacts > 10 * repeats(8));
}

TEST_CASE("self: two objects of one mesh are answered as two of meshes built alike") {
  const FloatingPointScope scope;
  std::size_t contacts = 0;
  for (const Eigen::Vector3d& beside : {Eigen::Vector3d(0.2, 0.1, 0.05), Eigen::Vector3d(0, 0, 0.3)}) {
    const SelfScene scene = waving_sheet(3, 0);
    const Body moved(scene.body.rest, mapped(scene.body.now, 1, beside));
    const Surface a = surface_of(scene.body);
    const Surface alike = surface_of(moved);
    Surface of_same_mesh(a.shared_mesh());
    REQUIRE(of_same_mesh.set_positions(moved.now.positions).taken());
    of_same_mesh.make_blocks();
    of_same_mesh.refit_vertices();
    of_same_mesh.refit_faces();
    for (const ContactDetail detail : all_details) {
      const PairQuery query = query_of(detail, 0.5);
      const PairAnswer answer = detect(a, of_same_mesh, query);
      check_same(answer, detect(a, alike, query));
      contacts += answer.contacts.size();
    }
  }
  CHECK(contacts > 100);
}

TEST_CASE("self: what a search remembers, and slices, do not change its answers") {
  const FloatingPointScope scope;
  SelfMet met;
  std::size_t by_list = 0;
  for (const ContactDetail detail : all_details)
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
      if (is_of_self(detail)) play_self(seed, detail, met, by_list);
  CHECK(met.contacts > 1000);
  CHECK(by_list > 50);
}

TEST_CASE("self: a surface of which nothing is tested with itself has no answer in any step") {
  const FloatingPointScope scope;
  for (const ContactDetail detail : all_details) {
    if (!is_of_self(detail)) continue;
    INFO("detail " << static_cast<int>(detail));
    SelfScene scene{sheet(1, 1, false), 0.25, 2};
    Surface surface = surface_of(scene.body);
    const auto exclusion = make_self_exclusion(surface.shared_mesh(), scene.rings);
    const FeatureFilter filter(FeatureFilter(nullptr, nullptr), self_query(scene, *exclusion, detail));
    PairQuery query = query_of(detail, scene.threshold);
    query.groups = &filter;
    query.slack = query.leaf_test_slack = query.list_slack = 0.125;
    PairDetector detector;
    LeafFront front;
    PairAnswer answer;
    PairCounters counters;
    for (int step = 0; step < 4; ++step) {
      detector.detect(surface, surface, query, front, answer, counters);
      REQUIRE(!answer.in_contact);
      REQUIRE(!answer.listed);
      for (Eigen::Vector3d& position : scene.body.now.positions) position.x() *= 0.99;
      REQUIRE(surface.set_positions(scene.body.now.positions).taken());
      surface.make_blocks();
      surface.refit_faces();
    }
  }
}

}  // namespace graze::tests
