// Every contact detail against brute force on random small scenes, half of them on a coarse grid where exact
// ties, parallel edges, coplanar and degenerate faces are common.

#include "support/random_scenes.hpp"

#include <iostream>

#include "core/comparison.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

constexpr std::uint64_t scene_count = 4000;

std::string scene_text(std::uint64_t seed, const oracle::RandomScene& scene) {
  return "seed " + std::to_string(seed) + ", threshold " + std::to_string(scene.threshold) +
         "\na: " + text_of(scene.a) + "b: " + text_of(scene.b);
}

}  // namespace

TEST_CASE("features of random scenes are those of brute force") {
  oracle::Coverage coverage;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < scene_count; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const auto expected = oracle::features(scene.a, scene.b, scene.threshold);
    const auto closest = oracle::closest(scene.a, scene.b, scene.threshold);
    const auto distance = oracle::surface_distance(scene.a, scene.b);
    coverage.count(scene, expected, closest, distance);
    contacts += expected.size();
    const Surface a = surface_of(scene.a);
    const Surface b = surface_of(scene.b);
    const Tolerance tolerance(scene.a, scene.b);
    INFO(scene_text(seed, scene));

    const PairAnswer all = detect(a, b, query_of(ContactDetail::features, scene.threshold));
    CHECK(difference_of(all.contacts, expected, tolerance) == "");
    CHECK(all.in_contact == !expected.empty());
    CHECK(difference_of(all.distance, all.witness, distance, tolerance) == "");

    const PairAnswer one = detect(a, b, query_of(ContactDetail::closest, scene.threshold));
    CHECK(difference_of(one.contacts, closest ? std::vector{*closest} : std::vector<oracle::Named>{},
                        tolerance) == "");
    CHECK(difference_of(one.distance, one.witness, distance, tolerance) == "");

    const PairAnswer none = detect(a, b, query_of(ContactDetail::none, scene.threshold));
    CHECK(none.in_contact == closest.has_value());
    CHECK(none.contacts.empty());
    CHECK(difference_of(none.distance, none.witness, distance, tolerance) == "");
  }
  for (const std::size_t count : coverage.kinds) CHECK(count > 0);
  for (const std::size_t count : coverage.closest_kinds) CHECK(count > 0);
  CHECK(coverage.piercings > 0);
  CHECK(coverage.folds > 0);
  CHECK(coverage.degenerate_faces > 0);
  CHECK(coverage.warped_quads > 0);
  CHECK(coverage.parallel_edges > 0);
  CHECK(coverage.zero_distances > 0);
  CHECK(coverage.at_threshold > 0);
  CHECK(coverage.without_contact > 0);
  std::cout << "compared " << scene_count << " scenes, " << contacts << " feature contacts\n";
}

TEST_CASE("vertices and regions of random scenes are those of brute force") {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < scene_count; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Surface a = surface_of(scene.a);
    const Surface b = surface_of(scene.b);
    const Tolerance tolerance(scene.a, scene.b);
    const auto distance = oracle::vertex_distance(scene.a, scene.b);
    INFO(scene_text(seed, scene));

    const auto vertices = oracle::vertices(scene.a, scene.b, scene.threshold);
    const PairAnswer all = detect(a, b, query_of(ContactDetail::vertices, scene.threshold));
    CHECK(difference_of(all.contacts, vertices, tolerance) == "");
    CHECK(difference_of(all.distance, all.witness, distance, tolerance) == "");
    CHECK(all.in_contact == !vertices.empty());
    contacts += vertices.size();

    const auto regions = oracle::regions(scene.a, scene.b, scene.threshold, scene.a, scene.b);
    const PairAnswer nearest = detect(a, b, query_of(ContactDetail::regions, scene.threshold));
    CHECK(difference_of(nearest.contacts, regions, tolerance) == "");
    CHECK(difference_of(nearest.distance, nearest.witness, distance, tolerance) == "");
  }
  CHECK(contacts > 0);
  std::cout << "compared " << scene_count << " scenes, " << contacts << " vertex contacts\n";
}

}  // namespace graze::tests
