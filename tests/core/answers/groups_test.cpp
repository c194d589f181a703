// Face groups against brute force that leaves out the same pairs of faces: every detail, from nothing and
// with what earlier queries left, in slices, and where middle vertices may not be looked at.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/pair/group_filter.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;
using oracle::Shape;

using Groups = std::vector<std::uint8_t>;

/// Groups of the faces of two shapes, and which of these are ignored.
struct Grouping {
  Groups of_a;
  Groups of_b;
  std::vector<std::pair<std::uint8_t, std::uint8_t>> ignored;

  [[nodiscard]] GroupFilter filter(const IndexedMesh& a, const IndexedMesh& b) const {
    GroupFilter made(std::make_shared<const FaceGroups>(a, of_a),
                     std::make_shared<const FaceGroups>(b, of_b));
    for (const auto& [group_a, group_b] : ignored) made.set_ignored(group_a, group_b, true);
    return made;
  }
  [[nodiscard]] oracle::FacePairs pairs(const Shape& a, const Shape& b) const {
    return {a, b, [&](std::uint32_t face_a, std::uint32_t face_b) {
              return std::find(ignored.begin(), ignored.end(), std::pair(of_a[face_a], of_b[face_b])) ==
                     ignored.end();
            }};
  }
};

Groups random_groups(Random& random, std::size_t face_count, std::uint32_t group_count) {
  Groups groups;
  for (std::size_t face = 0; face < face_count; ++face)
    groups.push_back(static_cast<std::uint8_t>(100 * random.below(group_count)));
  return groups;
}

/// Two or three groups on each side, of which some are ignored.
Grouping random_grouping(Random& random, const Shape& a, const Shape& b) {
  constexpr std::uint32_t groups = 3;
  Grouping grouping{random_groups(random, a.faces.size(), 2 + random.below(groups - 1)), {}, {}};
  grouping.of_b = random_groups(random, b.faces.size(), 2 + random.below(groups - 1));
  for (std::uint32_t group_a = 0; group_a < groups; ++group_a)
    for (std::uint32_t group_b = 0; group_b < groups; ++group_b)
      if (random.chance(0.4))
        grouping.ignored.emplace_back(static_cast<std::uint8_t>(100 * group_a),
                                      static_cast<std::uint8_t>(100 * group_b));
  return grouping;
}

/// Describes how an answer differs from brute force. Empty if it does not.
std::string difference_of(ContactDetail detail, const PairAnswer& answer, const Expected& expected,
                          const Tolerance& tolerance) {
  std::string text = tests::difference_of(answer.contacts, expected.contacts, tolerance);
  // `nearest` takes the distance from its contacts, of which none is on the fold of a quad.
  if (detail != ContactDetail::nearest)
    text += tests::difference_of(answer.distance, answer.witness, expected.distance, tolerance);
  if (answer.in_contact != expected.in_contact) text += "in contact or not is wrong\n";
  return text;
}

/// Counts what a test has met, so that it can assert that nothing is missing.
struct Met {
  std::size_t scenes = 0;
  std::size_t contacts = 0;
  std::size_t further = 0;  ///< scenes whose distance grew by what was left out
  std::size_t fewer = 0;    ///< scenes that lost contacts
};

/// Compares all details of one scene.
void check_scene(std::uint64_t seed, const Shape& a, const Shape& b, double threshold,
                 const Grouping& grouping, Met& met) {
  const oracle::FacePairs pairs = grouping.pairs(a, b);
  const Surface surface_a = surface_of({a});
  const Surface surface_b = surface_of({b});
  const GroupFilter filter = grouping.filter(surface_a.mesh(), surface_b.mesh());
  REQUIRE(filter.leaves_some() == pairs.are_some());
  if (!pairs.are_some()) return;
  ++met.scenes;
  for (const ContactDetail detail : all_details) {
    PairQuery query = query_of(detail, threshold);
    query.groups = &filter;
    const PairAnswer answer = detect(surface_a, surface_b, query);
    const Expected expected = expected_of(a, b, threshold, detail, a, b, pairs);
    INFO("seed " << seed << ", detail " << static_cast<int>(detail));
    REQUIRE(difference_of(detail, answer, expected, {a, b}) == "");
    met.contacts += answer.contacts.size();
    const PairAnswer all = detect(surface_a, surface_b, query_of(detail, threshold));
    met.further += all.distance.upper < answer.distance.lower ? 1U : 0U;
    met.fewer += all.contacts.size() > answer.contacts.size() ? 1U : 0U;
  }
}

/// A surface moved to other positions as a scene does it.
void move_to(Surface& surface, const Shape& shape, bool refits) {
  REQUIRE(surface.set_positions(shape.positions).taken());
  surface.make_blocks();
  if (!refits) return;
  surface.refit_vertices();
  surface.refit_faces();
}

/// A query that keeps a front and a list.
PairQuery keeping_query(ContactDetail detail, double threshold, const GroupFilter& filter) {
  PairQuery query = query_of(detail, threshold);
  query.groups = &filter;
  query.slack = query.leaf_test_slack = query.list_slack = 0.125;
  return query;
}

/// Moves a pair a little in each step, and compares each answer of a search that remembers the last ones.
void play(std::uint64_t seed, const oracle::RandomScene& scene, const Grouping& grouping,
          std::size_t& by_list, std::size_t& contacts) {
  const oracle::FacePairs pairs = grouping.pairs(scene.a, scene.b);
  if (!pairs.are_some()) return;
  for (const ContactDetail detail : all_details) {
    Surface a = surface_of({scene.a});
    Surface b = surface_of({scene.b});
    const GroupFilter filter = grouping.filter(a.mesh(), b.mesh());
    const PairQuery query = keeping_query(detail, scene.threshold, filter);
    PairDetector detector;
    LeafFront front;
    PairAnswer answer;
    PairCounters counters;
    Random random(seed);
    Shape now = scene.b;
    for (int step = 0; step < 5; ++step) {
      const Eigen::Vector3d way = random.vector(-0.03125, 0.03125);
      if (step > 0) now = mapped(now, 1, step % 2 == 0 ? way : Eigen::Vector3d(0, 0.03125, 0));
      move_to(b, now, step % 2 == 0);
      detector.detect(a, b, query, front, answer, counters);
      const Expected expected = expected_of(scene.a, now, scene.threshold, detail, scene.a, scene.b, pairs);
      INFO("seed " << seed << ", detail " << static_cast<int>(detail) << ", step " << step);
      REQUIRE(difference_of(detail, answer, expected, {scene.a, now}) == "");
      contacts += answer.contacts.size();
    }
    by_list += counters.pairs_by_list;
  }
}

/// Group 1 for the faces whose first corner is on one side of a plane, otherwise 0.
Groups groups_by_side(const Shape& shape, int axis, double plane) {
  Groups groups;
  for (const auto& face : shape.faces) groups.push_back(shape.positions[face[0]][axis] < plane ? 0 : 1);
  return groups;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("face groups: random scenes are those of brute force, part", "", ((int part), part), 0,
                       1, 2, 3, 4) {
  const FloatingPointScope scope;
  constexpr std::uint64_t scenes_of_part = repeats(500);
  Met met;
  for (std::uint64_t i = 0; met.scenes < scenes_of_part; ++i) {
    const std::uint64_t seed = 100000 * (part + 1) + 2 * i + (i % 8 == 7 ? 0 : 1);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed + 1);
    check_scene(seed, scene.a, scene.b, scene.threshold, random_grouping(random, scene.a, scene.b), met);
  }
  CHECK(met.contacts > 4 * scenes_of_part);
  CHECK(met.further > scenes_of_part / 4);
  CHECK(met.fewer > scenes_of_part / 5);
}

TEST_CASE("face groups: what a search remembers does not change its answers") {
  const FloatingPointScope scope;
  std::size_t by_list = 0;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 1; seed < 240; seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed + 7);
    play(seed, scene, random_grouping(random, scene.a, scene.b), by_list, contacts);
  }
  CHECK(by_list > 100);
  CHECK(contacts > 1000);
}

TEST_CASE("face groups: surfaces of several leaves are those of brute force") {
  const FloatingPointScope scope;
  Met met;
  for (std::uint64_t seed = 0; seed < repeats(4); ++seed) {
    const Shape a = random_soup(2 * seed + 1, 80, 60);
    const Shape b = mapped(random_soup(2 * seed + 2, 80, 60), 1, {0.75, 0, 0});
    Random random(seed);
    check_scene(seed, a, b, 0.05, random_grouping(random, a, b), met);
    // Whole regions are left out: a's upper part is looked at with b's further one alone.
    check_scene(seed, a, b, 0.05, {groups_by_side(a, 0, 0.5), groups_by_side(b, 0, 1.25), {{1, 0}, {0, 0}}},
                met);
    check_scene(seed, a, b, 0.25, {groups_by_side(a, 2, 0.5), groups_by_side(b, 2, 0.5), {{0, 0}, {1, 1}}},
                met);
  }
  CHECK(met.scenes == 3 * repeats(4));
  CHECK(met.contacts > 120 * repeats(4));
  CHECK(met.further > repeats(4));
}

TEST_CASE("face groups: slices give the answer of the whole") {
  const FloatingPointScope scope;
  const Shape& model = paper_models()[0].shape;
  const Eigen::Vector3d beside(0.9, 0.1, 0.05);
  const Surface a = surface_of({model});
  const Surface b = surface_of({mapped(model, 1, beside)});
  Random random(5);
  const Grouping grouping{random_groups(random, model.faces.size(), 3),
                          random_groups(random, model.faces.size(), 3),
                          {{0, 0}, {0, 100}, {100, 0}, {200, 200}}};
  const GroupFilter filter = grouping.filter(a.mesh(), b.mesh());
  for (const ContactDetail detail : all_details) {
    PairQuery query = query_of(detail, 0.02);
    query.groups = &filter;
    LargePair large;
    LeafFront front;
    PairAnswer answer;
    PairDetector detector;
    PairCounters counters;
    large.begin(a, b, query, front, answer);
    while (!large.advance(detector, counters))
      for (std::size_t i = large.slice_count(); i-- > 0;) large.run_slice(i, detector, counters);
    check_same(answer, detect(a, b, query));
  }
}

TEST_CASE("face groups: a limit of contacts keeps the nearest of the rest") {
  const FloatingPointScope scope;
  std::size_t cut = 0;
  for (std::uint64_t seed = 1; seed < 120; seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed);
    const Grouping grouping = random_grouping(random, scene.a, scene.b);
    const Surface a = surface_of({scene.a});
    const Surface b = surface_of({scene.b});
    const GroupFilter filter = grouping.filter(a.mesh(), b.mesh());
    if (!filter.leaves_some()) continue;
    PairQuery query = query_of(ContactDetail::features, scene.threshold);
    query.groups = &filter;
    const PairAnswer all = detect(a, b, query);
    query.contact_limit = 3;
    const PairAnswer some = detect(a, b, query);
    REQUIRE(some.contacts.size() == std::min<std::size_t>(3, all.contacts.size()));
    CHECK(some.distance.lower == all.distance.lower);
    CHECK(some.cut == (all.contacts.size() > 3));
    cut += some.cut ? 1U : 0U;
  }
  CHECK(cut > 10);
}

TEST_CASE("face groups: bounds to a tolerance hold, and contacts are exact") {
  const FloatingPointScope scope;
  std::size_t loose = 0;
  for (std::uint64_t seed = 1; seed < 600; seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed);
    const Grouping grouping = random_grouping(random, scene.a, scene.b);
    const oracle::FacePairs pairs = grouping.pairs(scene.a, scene.b);
    if (!pairs.are_some()) continue;
    const Surface a = surface_of({scene.a});
    const Surface b = surface_of({scene.b});
    const GroupFilter filter = grouping.filter(a.mesh(), b.mesh());
    PairQuery query = query_of(ContactDetail::none, scene.threshold);
    query.mode = AccuracyMode::within;
    query.tolerance = 0.5;
    query.groups = &filter;
    const PairAnswer answer = detect(a, b, query);
    const Expected expected =
        expected_of(scene.a, scene.b, scene.threshold, ContactDetail::none, scene.a, scene.b, pairs);
    INFO("seed " << seed);
    REQUIRE(answer.in_contact == expected.in_contact);
    REQUIRE(answer.distance.lower <= expected.distance.distance_down);
    REQUIRE(answer.distance.upper >= expected.distance.distance_up);
    REQUIRE(answer.distance.upper - answer.distance.lower <= 0.5 + 0x1p-40);
    loose += answer.distance.lower < expected.distance.distance_down ? 1U : 0U;
  }
  CHECK(loose > 10);
}

TEST_CASE("face groups: in paper mode vertices that are left out are in no contact") {
  const FloatingPointScope scope;
  // Every pair of regions passes the test of these epsilons, so that all vertices are looked at.
  const std::array<double, 2> epsilon{100, 0.5};
  std::size_t contacts = 0;
  for (std::uint64_t seed = 1; seed < 120; seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed);
    const Grouping grouping = random_grouping(random, scene.a, scene.b);
    const oracle::FacePairs pairs = grouping.pairs(scene.a, scene.b);
    if (!pairs.are_some()) continue;
    const Surface a = surface_of({scene.a});
    const Surface b = surface_of({scene.b});
    const GroupFilter filter = grouping.filter(a.mesh(), b.mesh());
    PairQuery query = query_of(ContactDetail::vertices, 0.5);
    query.mode = AccuracyMode::paper;
    query.epsilon = epsilon;
    query.groups = &filter;
    const PairAnswer answer = detect(a, b, query);
    const Expected expected =
        expected_of(scene.a, scene.b, 0.5, ContactDetail::vertices, scene.a, scene.b, pairs);
    INFO("seed " << seed);
    REQUIRE(tests::difference_of(answer.contacts, expected.contacts, {scene.a, scene.b}) == "");
    CHECK(answer.distance.upper == expected.distance.distance_up);
    contacts += answer.contacts.size();
    query.detail = ContactDetail::regions;
    for (const Contact& contact : detect(a, b, query).contacts)
      CHECK(pairs.may(contact.feature_a, contact.feature_b));
  }
  CHECK(contacts > 100);
}

TEST_CASE("face groups: bounds without a search are those of vertices that may be looked at") {
  for (std::uint64_t seed = 1; seed < 200; seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed);
    const Grouping grouping = random_grouping(random, scene.a, scene.b);
    const oracle::FacePairs pairs = grouping.pairs(scene.a, scene.b);
    if (!pairs.are_some()) continue;
    const Surface a = surface_of({scene.a});
    const Surface b = surface_of({scene.b});
    const GroupFilter filter = grouping.filter(a.mesh(), b.mesh());
    PairQuery query = query_of(ContactDetail::features, scene.threshold);
    query.groups = &filter;
    PairAnswer answer;
    PairDetector::outer_bounds(a, b, query, answer);
    CHECK(answer.distance.lower <= oracle::surface_distance(scene.a, scene.b, pairs).distance_down);
    CHECK(answer.distance.upper >= oracle::surface_distance(scene.a, scene.b, pairs).distance_up);
    CHECK(pairs.may(answer.witness.feature_a, answer.witness.feature_b));
  }
}

TEST_CASE("face groups: a filter says what is left, and lists what is ignored") {
  const auto mesh = mesh_of(box({0, 0, 0}, {1, 1, 1}));
  const auto groups = std::make_shared<const FaceGroups>(indexed(*mesh), Groups{0, 7, 7, 255, 7, 7});
  CHECK(groups->all().count() == 3);
  CHECK(groups->first_face_of(7) == 1);
  GroupFilter filter(groups, nullptr);
  CHECK((filter.leaves_some() && filter.leaves_all()));
  filter.set_ignored(7, 0, true);
  CHECK((filter.leaves_some() && !filter.leaves_all()));
  CHECK_FALSE(filter.may({FeatureRefKind::face, 1}, {FeatureRefKind::face, 0}));
  CHECK_FALSE(filter.may({FeatureRefKind::fold, 2}, {FeatureRefKind::vertex, 0}));
  CHECK(filter.may({FeatureRefKind::face, 3}, {FeatureRefKind::fold, 0}));
  const IndexedMesh& faces = indexed(*mesh);
  CHECK(filter.some_vertices(faces, faces).value()[0] == faces.face(0)[0]);
  filter.set_ignored(0, 0, true);
  CHECK(filter.some_vertices(faces, faces).value()[0] == faces.face(3)[0]);
  filter.set_ignored(3, 5, true);  // no face is in these
  filter.set_ignored(255, 0, true);
  CHECK((!filter.leaves_some() && !filter.leaves_all()));
  std::vector<std::pair<int, int>> ignored;
  filter.visit_ignored([&](std::uint8_t a, std::uint8_t b) { ignored.emplace_back(a, b); });
  CHECK(ignored == std::vector<std::pair<int, int>>{{0, 0}, {3, 5}, {7, 0}, {255, 0}});
  for (const std::uint8_t group : {std::uint8_t{0}, std::uint8_t{7}, std::uint8_t{255}})
    filter.set_ignored(group, 0, false);
  CHECK((filter.leaves_some() && filter.leaves_all()));
}

}  // namespace graze::tests
