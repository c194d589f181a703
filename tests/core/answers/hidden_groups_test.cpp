// Hidden groups against brute force that leaves out all pairs with their faces, and against meshes without
// these faces: every detail, with and without ignored groups, and what a search remembers.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "closest_features/seen_faces.hpp"
#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/pair/group_filter.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/pair_counters.hpp"
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

bool has(const Groups& groups, std::uint8_t group) {
  return std::find(groups.begin(), groups.end(), group) != groups.end();
}

/// The groups of the faces of a shape, and which of these are hidden.
struct HiddenGroups {
  Groups of_faces;
  Groups hidden;

  [[nodiscard]] bool hides(std::uint32_t face) const { return has(hidden, of_faces[face]); }
  [[nodiscard]] std::shared_ptr<const FaceGroups> in(const IndexedMesh& mesh) const {
    return std::make_shared<const FaceGroups>(mesh, of_faces, hidden);
  }
};

/// One to three groups, of which some are hidden. Some of the hidden ones have no face.
HiddenGroups random_groups(Random& random, const Shape& shape) {
  HiddenGroups groups;
  const std::uint32_t count = 1 + random.below(3);
  for (std::size_t face = 0; face < shape.faces.size(); ++face)
    groups.of_faces.push_back(static_cast<std::uint8_t>(100 * random.below(count)));
  for (const std::uint8_t group : {std::uint8_t{0}, std::uint8_t{100}, std::uint8_t{200}, std::uint8_t{5}})
    if (random.chance(0.4)) groups.hidden.push_back(group);
  return groups;
}

/// Two shapes with hidden groups. Faces of group 0 of both may be ignored besides.
struct HiddenPair {
  HiddenPair(Random& random, const Shape& a, const Shape& b)
      : of_a(random_groups(random, a)), of_b(random_groups(random, b)), ignores(random.chance(0.3)) {}

  [[nodiscard]] oracle::FacePairs pairs(const Shape& a, const Shape& b) const {
    return {a, b, [&](std::uint32_t face_a, std::uint32_t face_b) {
              return !of_a.hides(face_a) && !of_b.hides(face_b) &&
                     !(ignores && of_a.of_faces[face_a] == 0 && of_b.of_faces[face_b] == 0);
            }};
  }

  HiddenGroups of_a;
  HiddenGroups of_b;
  bool ignores;
};

/// The filter of a pair: one without ignored groups where none are.
class PairFilterOf {
 public:
  PairFilterOf(const HiddenPair& pair, const IndexedMesh& a, const IndexedMesh& b)
      : a_(pair.of_a.in(a)), b_(pair.of_b.in(b)), plain_(a_.get(), b_.get()), ignoring_(a_, b_) {
    is_plain_ = !pair.ignores;
    if (pair.ignores) ignoring_.set_ignored(0, 0, true);
  }
  [[nodiscard]] const FeatureFilter& operator*() const { return is_plain_ ? plain_ : ignoring_; }

 private:
  std::shared_ptr<const FaceGroups> a_;
  std::shared_ptr<const FaceGroups> b_;
  FeatureFilter plain_;
  GroupFilter ignoring_;
  bool is_plain_;
};

/// Describes how an answer differs from brute force in a detail other than `nearest`. Empty if it does not.
std::string difference_of(const PairAnswer& answer, const Expected& expected, const Tolerance& tolerance) {
  std::string text = tests::difference_of(answer.contacts, expected.contacts, tolerance);
  text += tests::difference_of(answer.distance, answer.witness, expected.distance, tolerance);
  if (answer.in_contact != expected.in_contact) text += "in contact or not is wrong\n";
  return text;
}

/// A contact by what its features are in any mesh with these vertices.
using VertexNames = std::tuple<ContactKind, std::vector<std::uint32_t>, std::vector<std::uint32_t>>;

std::vector<std::uint32_t> vertices_of(const IndexedMesh& mesh, const Feature& feature) {
  std::vector<std::uint32_t> vertices{feature.index};
  if (feature.kind == FeatureKind::edge) {
    const auto ends = mesh.edge(feature.index);
    vertices.assign(ends.begin(), ends.end());
  }
  if (feature.kind == FeatureKind::face) {
    const auto corners = mesh.face(feature.index);
    vertices.assign(corners.begin(), corners.end());
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

std::vector<VertexNames> names_of(std::span<const Contact> contacts, const IndexedMesh& a,
                                  const IndexedMesh& b) {
  std::vector<VertexNames> names;
  for (const Contact& contact : contacts)
    names.emplace_back(contact.kind, vertices_of(a, contact.feature_a), vertices_of(b, contact.feature_b));
  std::sort(names.begin(), names.end());
  // Two faces with the same corners have one name.
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// The shape without the faces that are hidden.
Shape seen_part(const Shape& shape, const HiddenGroups& groups) {
  Shape seen{shape.positions, {}};
  for (std::uint32_t face = 0; face < shape.faces.size(); ++face)
    if (!groups.hides(face)) seen.faces.push_back(shape.faces[face]);
  return seen;
}

bool has_quads(const Shape& shape) {
  return std::any_of(shape.faces.begin(), shape.faces.end(),
                     [](const auto& corners) { return corners.size() > 3; });
}

/// The faces that have an edge, and whether they are hidden.
struct EdgeFaces {
  std::vector<std::uint32_t> seen;
  bool hides_some = false;

  [[nodiscard]] bool is_seam() const { return hides_some && seen.size() == 1; }
};

EdgeFaces faces_of_edge(const Shape& shape, const HiddenGroups& groups, std::uint32_t low,
                        std::uint32_t high) {
  EdgeFaces faces;
  for (std::uint32_t face = 0; face < shape.faces.size(); ++face) {
    const auto& corners = shape.faces[face];
    bool has_edge = false;
    for (std::size_t i = 0; i < corners.size(); ++i)
      has_edge =
          has_edge || std::minmax(corners[i], corners[(i + 1) % corners.size()]) == std::minmax(low, high);
    if (!has_edge) continue;
    if (groups.hides(face))
      faces.hides_some = true;
    else
      faces.seen.push_back(face);
  }
  return faces;
}

/// The triangle of a face that has two vertices next to each other, in the face's sense, as (from, to,
/// across).
std::array<std::uint32_t, 3> triangle_at(const std::vector<std::uint32_t>& corners, std::uint32_t low,
                                         std::uint32_t high) {
  for (std::size_t last = 2; last < corners.size(); ++last) {
    const std::array<std::uint32_t, 3> triangle{corners[0], corners[last - 1], corners[last]};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<std::uint32_t, 3> turned{triangle[i], triangle[(i + 1) % 3], triangle[(i + 2) % 3]};
      if (std::minmax(turned[0], turned[1]) == std::minmax(low, high)) return turned;
    }
  }
  return {low, high, low};
}

/// The seams of a shape, each with the triangle beside it.
std::vector<std::array<std::uint32_t, 3>> seams_of(const Shape& shape, const HiddenGroups& groups) {
  std::vector<std::array<std::uint32_t, 3>> seams;
  for (const auto& [low, high] : oracle::edges_of(shape)) {
    const EdgeFaces faces = faces_of_edge(shape, groups, low, high);
    if (faces.is_seam()) seams.push_back(triangle_at(shape.faces[faces.seen[0]], low, high));
  }
  return seams;
}

/// The shape without hidden faces, and with a triangle behind each seam, in the plane of the seen face.
Shape continued(const Shape& shape, const HiddenGroups& groups) {
  Shape result = seen_part(shape, groups);
  for (const auto& [from, to, across] : seams_of(shape, groups)) {
    result.faces.push_back({to, from, static_cast<std::uint32_t>(result.positions.size())});
    result.positions.push_back(shape.positions[from] + shape.positions[to] - shape.positions[across]);
  }
  return result;
}

/// Whether the seen face beside some seam has no area there, so that nothing says how it goes on.
bool goes_on_nowhere(const Shape& shape, const HiddenGroups& groups) {
  const auto seams = seams_of(shape, groups);
  return std::any_of(seams.begin(), seams.end(), [&](const auto& seam) {
    const auto& [from, to, across] = seam;
    const Eigen::Vector3d along = shape.positions[to] - shape.positions[from];
    return along.cross(shape.positions[across] - shape.positions[from]).norm() < 1e-12;
  });
}

/// Whether the way from a feature leads past a seam by more than 10.2° from square to the seen face. Of a
/// vertex it may also lead as far over the face. `is_tie` is set where that is a matter of rounding.
bool leads_past(const Shape& shape, const HiddenGroups& groups, const std::vector<std::uint32_t>& feature,
                const Eigen::Vector3d& way, bool& is_tie) {
  for (const auto& [from, to, across] : seams_of(shape, groups)) {
    const std::array ends{from, to};
    const auto is_end = [&](std::uint32_t vertex) { return vertex == ends[0] || vertex == ends[1]; };
    if (feature.size() > 2 || !std::all_of(feature.begin(), feature.end(), is_end)) continue;
    const Eigen::Vector3d along = (shape.positions[to] - shape.positions[from]).normalized();
    const Eigen::Vector3d beside = shape.positions[across] - shape.positions[from];
    const Eigen::Vector3d inward = along.cross(beside.cross(along));
    if (!(inward.norm() > 1e-12)) continue;
    const double lean = -way.normalized().dot(inward.normalized());
    const double past = (feature.size() == 1 ? std::abs(lean) : lean) - std::sqrt(1.0 / 32);
    if (std::abs(past) < 1e-9) is_tie = true;
    if (past > 0) return true;
  }
  return false;
}

bool is_piercing(const Contact& contact) {
  return contact.kind == ContactKind::EF && contact.distance == 0;
}

/// A surface moved to other positions as a scene does it.
void move_to(Surface& surface, const Shape& shape, bool refits) {
  REQUIRE(surface.set_positions(shape.positions).taken());
  surface.make_blocks();
  if (!refits) return;
  surface.refit_vertices();
  surface.refit_faces();
}

}  // namespace

TEST_CASE("hidden groups: random scenes are those of brute force") {
  const FloatingPointScope scope;
  std::size_t scenes = 0;
  std::size_t contacts = 0;
  std::size_t further = 0;
  std::size_t nothing = 0;
  for (std::uint64_t seed = 1; seed < repeats(2'400); seed += seed % 16 == 15 ? 1 : 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed);
    const HiddenPair pair(random, scene.a, scene.b);
    const oracle::FacePairs pairs = pair.pairs(scene.a, scene.b);
    const Surface a = surface_of({scene.a});
    const Surface b = surface_of({scene.b});
    const PairFilterOf filter(pair, a.mesh(), b.mesh());
    INFO("seed " << seed);
    REQUIRE((*filter).leaves_some() == pairs.are_some());
    if (!pairs.are_some()) {
      ++nothing;
      continue;
    }
    ++scenes;
    for (const ContactDetail detail : all_details) {
      if (detail == ContactDetail::nearest) continue;  // seams are not those of brute force
      PairQuery query = query_of(detail, scene.threshold);
      query.groups = &*filter;
      const PairAnswer answer = detect(a, b, query);
      const Expected expected =
          expected_of(scene.a, scene.b, scene.threshold, detail, scene.a, scene.b, pairs);
      INFO("detail " << static_cast<int>(detail));
      REQUIRE(difference_of(answer, expected, {scene.a, scene.b}) == "");
      contacts += answer.contacts.size();
      const PairAnswer all = detect(a, b, query_of(detail, scene.threshold));
      further += all.distance.upper < answer.distance.lower ? 1U : 0U;
    }
  }
  CHECK(scenes > repeats(500));
  CHECK(nothing > repeats(100));
  CHECK(contacts > 4 * scenes);
  CHECK(further > scenes / 4);
}

TEST_CASE("hidden groups: contacts are those of meshes without the hidden faces") {
  const FloatingPointScope scope;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 1; seed < 6000; seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed + 3);
    HiddenPair pair(random, scene.a, scene.b);
    pair.ignores = false;
    // The edge of a hidden face may join the diagonal of a quad, which is no fold then.
    if (has_quads(scene.a) || has_quads(scene.b)) continue;
    const Shape seen_a = seen_part(scene.a, pair.of_a);
    const Shape seen_b = seen_part(scene.b, pair.of_b);
    if (seen_a.faces.empty() || seen_b.faces.empty()) continue;
    const Surface a = surface_of({scene.a});
    const Surface b = surface_of({scene.b});
    const Surface without_a = surface_of({seen_a});
    const Surface without_b = surface_of({seen_b});
    const PairFilterOf filter(pair, a.mesh(), b.mesh());
    for (const ContactDetail detail : {ContactDetail::features, ContactDetail::vertices}) {
      PairQuery query = query_of(detail, scene.threshold);
      const PairAnswer expected = detect(without_a, without_b, query);
      query.groups = &*filter;
      const PairAnswer answer = detect(a, b, query);
      INFO("seed " << seed << ", detail " << static_cast<int>(detail));
      REQUIRE(names_of(answer.contacts, a.mesh(), b.mesh()) ==
              names_of(expected.contacts, without_a.mesh(), without_b.mesh()));
      CHECK(answer.distance.upper == expected.distance.upper);
      CHECK(answer.in_contact == expected.in_contact);
      contacts += answer.contacts.size();
    }
  }
  CHECK(contacts > 2000);
}

TEST_CASE("hidden groups: at seams nearest lists what a surface that goes on behind them has") {
  const FloatingPointScope scope;
  std::size_t edges = 0;
  std::size_t fewer_edges = 0;
  std::size_t vertices = 0;
  std::size_t past = 0;
  for (std::uint64_t seed = 1; seed < repeats(4'000); seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed + 9);
    HiddenPair pair(random, scene.a, scene.b);
    pair.ignores = false;
    const Shape continued_a = continued(scene.a, pair.of_a);
    const Shape continued_b = continued(scene.b, pair.of_b);
    if (continued_a.faces.empty() || continued_b.faces.empty()) continue;
    const Surface a = surface_of({scene.a});
    const Surface b = surface_of({scene.b});
    const PairFilterOf filter(pair, a.mesh(), b.mesh());
    PairQuery query = query_of(ContactDetail::nearest, scene.threshold);
    const Surface on_a = surface_of({continued_a});
    const Surface on_b = surface_of({continued_b});
    PairAnswer on = detect(on_a, on_b, query);
    query.groups = &*filter;
    PairAnswer answer = detect(a, b, query);
    INFO("seed " << seed);

    // Vertices, and what pierces.
    const Expected expected = expected_of(scene.a, scene.b, scene.threshold, ContactDetail::nearest, scene.a,
                                          scene.b, pair.pairs(scene.a, scene.b));
    std::vector<oracle::Named> named;
    bool is_tie = false;
    for (const oracle::Named& each : expected.contacts) {
      if (each.kind > ContactKind::VF && !each.pierced) continue;
      const Eigen::Vector3d way = each.point_b - each.point_a;
      const auto of_a = vertices_of(a.mesh(), each.a);
      const auto of_b = vertices_of(b.mesh(), each.b);
      const bool is_past = each.distance > 0 && (leads_past(scene.a, pair.of_a, of_a, way, is_tie) ||
                                                 leads_past(scene.b, pair.of_b, of_b, -way, is_tie));
      past += is_past ? 1U : 0U;
      if (!is_past) named.push_back(each);
    }
    if (is_tie || goes_on_nowhere(scene.a, pair.of_a) || goes_on_nowhere(scene.b, pair.of_b)) continue;
    std::vector<Contact> got;
    std::copy_if(
        answer.contacts.begin(), answer.contacts.end(), std::back_inserter(got),
        [](const Contact& contact) { return contact.kind <= ContactKind::VF || is_piercing(contact); });
    REQUIRE(tests::difference_of(got, named, {scene.a, scene.b}) == "");
    PairQuery of_features = query;
    of_features.detail = ContactDetail::features;
    const PairAnswer features = detect(a, b, of_features);
    REQUIRE(answer.in_contact == features.in_contact);
    vertices += got.size();

    // Pairs of edges. What pierces the surface behind a seam may make other pairs sunk.
    if (std::any_of(on.contacts.begin(), on.contacts.end(), is_piercing) ||
        std::any_of(answer.contacts.begin(), answer.contacts.end(), is_piercing))
      continue;
    const auto is_at_seam = [](const Surface& surface, const FaceGroups& groups, const Feature& edge) {
      return seen_faces(groups, surface.mesh(), edge.index).are_at_seam();
    };
    if (answer.contacts.size() == 1 && answer.contacts[0].kind == ContactKind::EE &&
        answer.contacts[0].distance > 0 &&
        (is_at_seam(a, (*filter).of_a(), answer.contacts[0].feature_a) ||
         is_at_seam(b, (*filter).of_b(), answer.contacts[0].feature_b)))
      continue;
    const auto is_other = [&](const Contact& contact) { return contact.kind != ContactKind::EE; };
    std::erase_if(answer.contacts, is_other);
    const auto is_new = [](const Surface& surface, const Shape& shape, const Feature& edge) {
      return surface.mesh().edge(edge.index)[1] >= shape.positions.size();
    };
    std::erase_if(on.contacts, [&](const Contact& contact) {
      return is_other(contact) || is_new(on_a, scene.a, contact.feature_a) ||
             is_new(on_b, scene.b, contact.feature_b);
    });
    REQUIRE(names_of(answer.contacts, a.mesh(), b.mesh()) == names_of(on.contacts, on_a.mesh(), on_b.mesh()));
    edges += answer.contacts.size();
    PairAnswer without =
        detect(surface_of({seen_part(scene.a, pair.of_a)}), surface_of({seen_part(scene.b, pair.of_b)}),
               query_of(ContactDetail::nearest, scene.threshold));
    std::erase_if(without.contacts, is_other);
    fewer_edges += without.contacts.size() > answer.contacts.size() ? 1U : 0U;
  }
  CHECK(vertices > repeats(1000));
  CHECK(past > repeats(50));
  CHECK(edges > repeats(50));
  CHECK(fewer_edges > repeats(20));
}

TEST_CASE("hidden groups: what a search remembers does not change its answers") {
  const FloatingPointScope scope;
  std::size_t by_list = 0;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 1; seed < 160; seed += 2) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    Random random(seed + 5);
    const HiddenPair pair(random, scene.a, scene.b);
    const oracle::FacePairs pairs = pair.pairs(scene.a, scene.b);
    if (!pairs.are_some()) continue;
    for (const ContactDetail detail : all_details) {
      Surface a = surface_of({scene.a});
      Surface b = surface_of({scene.b});
      const PairFilterOf filter(pair, a.mesh(), b.mesh());
      PairQuery query = query_of(detail, scene.threshold);
      query.groups = &*filter;
      PairQuery keeping = query;
      keeping.slack = keeping.leaf_test_slack = keeping.list_slack = 0.125;
      PairDetector detector;
      LeafFront front;
      PairAnswer answer;
      PairCounters counters;
      Shape now = scene.b;
      for (int step = 0; step < 5; ++step) {
        const Eigen::Vector3d way = random.vector(-0.03125, 0.03125);
        if (step > 0) now = mapped(now, 1, step % 2 == 0 ? way : Eigen::Vector3d(0, 0.03125, 0));
        move_to(b, now, step % 2 == 0);
        detector.detect(a, b, keeping, front, answer, counters);
        INFO("seed " << seed << ", detail " << static_cast<int>(detail) << ", step " << step);
        check_same(answer, detect(a, surface_of({scene.b, now}), query));
        contacts += answer.contacts.size();
      }
      by_list += counters.pairs_by_list;
    }
  }
  CHECK(by_list > 100);
  CHECK(contacts > 1000);
}

TEST_CASE("hidden groups: a filter says what is left") {
  const auto mesh = mesh_of(box({0, 0, 0}, {1, 1, 1}));
  const Groups of_faces{0, 7, 7, 255, 7, 7};
  const auto of = [&](const Groups& hidden) { return FaceGroups(indexed(*mesh), of_faces, hidden); };
  const FaceGroups none = of({});
  CHECK_FALSE(none.hides_some());
  const FaceGroups absent = of({1, 2, 1});
  CHECK_FALSE(absent.hides_some());
  CHECK(FeatureFilter(&absent, nullptr).leaves_all());
  const FaceGroups some = of({7, 7, 3});
  CHECK((some.hides_some() && some.hides(1) && !some.hides(0) && !some.hides(3)));
  CHECK(some.first_seen_face() == 0);
  CHECK(some.all().count() == 2);
  const FeatureFilter filter(&some, nullptr);
  CHECK((filter.leaves_some() && !filter.leaves_all()));
  CHECK(filter.may({FeatureRefKind::face, 3}, {FeatureRefKind::face, 0}));
  CHECK_FALSE(filter.may({FeatureRefKind::face, 1}, {FeatureRefKind::face, 0}));
  CHECK_FALSE(filter.may({FeatureRefKind::fold, 2}, {FeatureRefKind::vertex, 0}));
  const FaceGroups all = of({0, 7, 255});
  CHECK(all.all().none());
  CHECK_FALSE(FeatureFilter(nullptr, &all).leaves_some());
  // Watching does not show what is hidden.
  GroupFilter watched(std::make_shared<const FaceGroups>(some), nullptr);
  CHECK_FALSE(watched.leaves_all());
  watched.set_ignored(7, 0, true);
  watched.set_ignored(7, 0, false);
  CHECK_FALSE(watched.may({FeatureRefKind::face, 1}, {FeatureRefKind::face, 0}));
  watched.set_ignored(0, 0, true);
  const IndexedMesh& faces = indexed(*mesh);
  CHECK(watched.some_vertices(faces, faces).value()[0] == faces.face(3)[0]);
  watched.set_groups_of_a(std::make_shared<const FaceGroups>(of({255, 7})));
  CHECK_FALSE(watched.leaves_some());
  // Without groups all faces are in group 0.
  const FaceGroups hides_zero(indexed(*mesh), {}, std::array<std::uint8_t, 1>{0});
  CHECK((hides_zero.hides_some() && hides_zero.all().none()));
}

}  // namespace graze::tests
