// Scenes with no ties at all: turned, mirrored, renumbered and reordered they have the same contacts.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numeric>
#include <tuple>

#include "hard_cases/scene_comparison.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

constexpr std::array details{ContactDetail::none, ContactDetail::closest, ContactDetail::vertices,
                             ContactDetail::features, ContactDetail::nearest};
static_assert(details.size() + 1 == all_details.size(), "all but regions, whose octree is axis-aligned");

/// Two shapes every vertex of which has been moved at random, so that nothing is parallel, coplanar, at the
/// threshold or at a change of kind to 1e-12.
struct GenericScene {
  Shape a, b;
  double threshold = 0;
};

GenericScene generic_scene(std::uint64_t seed) {
  Random random(seed);
  oracle::RandomScene given = oracle::random_scene(2 * seed);
  for (Shape* shape : {&given.a, &given.b})
    for (Vector3d& position : shape->positions)
      for (double& coordinate : position) coordinate += random.between(-0.02, 0.02);
  return {given.a, given.b, given.threshold + random.between(0.01, 0.02)};
}

/// A shape with other numbers, and what each old number became.
struct Renumbered {
  Shape shape;
  std::vector<std::uint32_t> vertices, faces;
};

std::vector<std::uint32_t> shuffled_numbers(std::size_t count, Random& random) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  for (std::size_t i = count; i > 1; --i)
    std::swap(numbers[i - 1], numbers[random.below(static_cast<std::uint32_t>(i))]);
  return numbers;
}

/// Vertices and faces in another order. A triangle may start at another corner, and a quad keeps its first.
Renumbered renumbered(const Shape& shape, Random& random) {
  Renumbered result{shape, shuffled_numbers(shape.positions.size(), random),
                    shuffled_numbers(shape.faces.size(), random)};
  for (std::size_t vertex = 0; vertex < shape.positions.size(); ++vertex)
    result.shape.positions[result.vertices[vertex]] = shape.positions[vertex];
  for (std::size_t face = 0; face < shape.faces.size(); ++face) {
    auto corners = shape.faces[face];
    for (std::uint32_t& corner : corners) corner = result.vertices[corner];
    if (corners.size() == 3) std::rotate(corners.begin(), corners.begin() + random.below(3), corners.end());
    result.shape.faces[result.faces[face]] = corners;
  }
  return result;
}

/// The new name of each feature of a shape that was renumbered.
class FeatureMap {
 public:
  FeatureMap(const Shape& shape, const Renumbered& to) : to_(to), edges_(oracle::edges_of(shape)) {
    const auto edges = oracle::edges_of(to.shape);
    for (std::uint32_t i = 0; i < edges.size(); ++i) number_[edges[i]] = i;
  }
  [[nodiscard]] Feature operator()(const Feature& feature) const {
    if (feature.kind == FeatureKind::vertex) return {feature.kind, to_.vertices[feature.index]};
    if (feature.kind == FeatureKind::face) return {feature.kind, to_.faces[feature.index]};
    const auto [low, high] = edges_[feature.index];
    const auto ends = std::minmax(to_.vertices[low], to_.vertices[high]);
    return {feature.kind, number_.at({ends.first, ends.second})};
  }

 private:
  const Renumbered& to_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> number_;
};

struct NamedContact {
  std::tuple<ContactKind, Feature, Feature> name;
  double distance = 0;
  Side side_a = Side::none, side_b = Side::none;
};

struct Answer {
  bool in_contact = false;
  DistanceBounds distance;
  std::vector<NamedContact> contacts;

  void sort() {
    std::sort(contacts.begin(), contacts.end(),
              [](const NamedContact& left, const NamedContact& right) { return left.name < right.name; });
  }
  /// Which pairs of edges are sunk goes by their sides, which a mirror turns round.
  void forget_edges() {
    std::erase_if(contacts,
                  [](const NamedContact& contact) { return std::get<0>(contact.name) == ContactKind::EE; });
  }
};

Answer answer_of(const Body& a, const Body& b, double threshold, ContactDetail detail) {
  BodyScene scene({a, b}, settings_of(threshold, infinity, detail));
  const ReportHandle report = scene.step({a, b});
  const PairReport& row = only_pair(*report);
  Answer answer{row.phase == PairPhase::began, row.distance, {}};
  for (const Contact& contact : report->contacts(row))
    answer.contacts.push_back({{contact.kind, contact.feature_a, contact.feature_b},
                               contact.distance,
                               contact.side_a,
                               contact.side_b});
  answer.sort();
  return answer;
}

/// Checks that both answers have the same contacts, at distances that differ by at most `error`.
void check_same(const Answer& now, const Answer& before, double error) {
  REQUIRE(now.in_contact == before.in_contact);
  REQUIRE(std::abs(now.distance.lower - before.distance.lower) <= error);
  REQUIRE(std::abs(now.distance.upper - before.distance.upper) <= error);
  REQUIRE(now.contacts.size() == before.contacts.size());
  for (std::size_t i = 0; i < now.contacts.size(); ++i) {
    REQUIRE(now.contacts[i].name == before.contacts[i].name);
    REQUIRE(std::abs(now.contacts[i].distance - before.contacts[i].distance) <= error);
  }
}

/// Whether `closest` has many contacts at distance 0 to choose from, which it does by number.
bool is_chosen_by_number(const Answer& answer, ContactDetail detail) {
  return detail == ContactDetail::closest && answer.distance.upper == 0;
}

/// Calls `check(scene, detail, answer)` for every scene, and counts.
template <typename Check>
void for_each_scene(const char* what, const Check& check) {
  std::size_t scenes = 0;
  std::size_t contacts = 0;
  std::array<std::size_t, 6> kinds{};
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const GenericScene scene = generic_scene(seed);
    for (const ContactDetail detail : details) {
      INFO("seed " << seed << ", detail " << static_cast<int>(detail) << "\na: " << text_of(scene.a)
                   << "b: " << text_of(scene.b));
      const Answer answer = answer_of(scene.a, scene.b, scene.threshold, detail);
      check(seed, scene, detail, answer);
      ++scenes;
      contacts += answer.contacts.size();
      for (const NamedContact& contact : answer.contacts)
        ++kinds[static_cast<std::size_t>(std::get<0>(contact.name))];
    }
  }
  for (const std::size_t count : kinds) CHECK(count > 0);
  std::cout << "compared " << scenes << " " << what << " scenes, " << contacts << " contacts\n";
}

/// A few units in the last place of coordinates of a few units.
constexpr double few_units = 0x1p-48;

Side other_side(Side side) {
  if (side == Side::none) return side;
  return side == Side::front ? Side::back : Side::front;
}

}  // namespace

TEST_CASE("generic scenes: turned by arbitrary angles") {
  for_each_scene("turned", [](std::uint64_t seed, const GenericScene& scene, ContactDetail detail,
                              const Answer& answer) {
    // At rest as they were, so that the mesh is the same one.
    const Body a(scene.a, turned(scene.a, seed));
    const Body b(scene.b, turned(scene.b, seed));
    check_same(answer_of(a, b, scene.threshold, detail), answer, few_units);
  });
}

TEST_CASE("generic scenes: mirrored") {
  for_each_scene("mirrored", [](std::uint64_t seed, const GenericScene& scene, ContactDetail detail,
                                const Answer& answer) {
    const auto mirrored = [&](Shape shape) {
      for (Vector3d& position : shape.positions) position[static_cast<int>(seed % 3)] *= -1;
      return shape;
    };
    Answer now = answer_of(mirrored(scene.a), mirrored(scene.b), scene.threshold, detail);
    Answer before = answer;
    if (detail == ContactDetail::nearest) {
      now.forget_edges();
      before.forget_edges();
    }
    check_same(now, before, 0x1p-52);
    for (std::size_t i = 0; i < now.contacts.size(); ++i) {
      if (now.contacts[i].distance == 0) continue;
      REQUIRE(now.contacts[i].side_a == other_side(before.contacts[i].side_a));
      REQUIRE(now.contacts[i].side_b == other_side(before.contacts[i].side_b));
    }
  });
}

TEST_CASE("generic scenes: vertices and faces in another order") {
  for_each_scene("renumbered", [](std::uint64_t seed, const GenericScene& scene, ContactDetail detail,
                                  const Answer& answer) {
    if (is_chosen_by_number(answer, detail)) return;
    Random random(seed + 77);
    const Renumbered a = renumbered(scene.a, random);
    const Renumbered b = renumbered(scene.b, random);
    const FeatureMap map_a(scene.a, a);
    const FeatureMap map_b(scene.b, b);
    Answer expected = answer;
    for (NamedContact& contact : expected.contacts) {
      auto& [kind, feature_a, feature_b] = contact.name;
      feature_a = map_a(feature_a);
      feature_b = map_b(feature_b);
    }
    expected.sort();
    check_same(answer_of(a.shape, b.shape, scene.threshold, detail), expected, few_units);
  });
}

TEST_CASE("generic scenes: objects added in another order") {
  for_each_scene("reordered",
                 [](std::uint64_t, const GenericScene& scene, ContactDetail detail, const Answer& answer) {
                   if (is_chosen_by_number(answer, detail)) return;
                   Answer expected = answer;
                   for (NamedContact& contact : expected.contacts)
                     std::swap(std::get<1>(contact.name), std::get<2>(contact.name));
                   expected.sort();
                   check_same(answer_of(scene.b, scene.a, scene.threshold, detail), expected, few_units);
                 });
}

}  // namespace graze::tests
