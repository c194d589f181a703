// Every contact detail against brute force on random small scenes: most on a coarse grid, where exact ties,
// parallel edges, coplanar and degenerate faces are common, the others generic. In parts, so that they run
// side by side.

#include "support/random/random_scenes.hpp"

#include <iostream>

#include "core/comparison.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/reduce.hpp"

namespace graze::tests {
namespace {

constexpr std::uint64_t part_count = 10;
constexpr std::uint64_t grid_scenes_of_part = repeats(10'000) / part_count;
constexpr std::uint64_t generic_scenes_of_part = grid_scenes_of_part / 5;

/// Describes how the library's answers about two shapes at rest, at every detail, differ from brute force.
std::string difference_of(const TwoShapes& scene) {
  return compare(scene.a, scene.b, scene.threshold).difference;
}

/// How often the scenes so far reached each case.
void count(oracle::Coverage& coverage, const oracle::RandomScene& scene) {
  coverage.count(scene, oracle::features(scene.a, scene.b, scene.threshold),
                 oracle::closest(scene.a, scene.b, scene.threshold),
                 oracle::surface_distance(scene.a, scene.b));
}

/// Compares the scene of a seed and returns how many contacts that were. One that differs is reduced.
std::size_t check(std::uint64_t seed, const oracle::RandomScene& scene) {
  const Comparison comparison = compare(scene.a, scene.b, scene.threshold);
  if (!comparison.difference.empty())
    FAIL_CHECK("seed " << seed << ": " << comparison.difference << "reduced:\n"
                       << reduced_text({scene.a, scene.b, scene.threshold}, difference_of));
  return comparison.contacts;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("10,000 random scenes are those of brute force, part", "", ((int part), part), 0, 1, 2,
                       3, 4, 5, 6, 7, 8, 9) {
  std::size_t contacts = 0;
  const std::uint64_t first = part * grid_scenes_of_part;
  for (std::uint64_t i = first; i < first + grid_scenes_of_part; ++i) {
    const oracle::RandomScene scene = oracle::random_scene(2 * i + 1);
    REQUIRE(scene.on_grid);
    contacts += check(2 * i + 1, scene);
  }
  for (std::uint64_t i = 0; i < generic_scenes_of_part; ++i) {
    const std::uint64_t seed = 2 * (part * generic_scenes_of_part + i);
    contacts += check(seed, oracle::random_scene(seed));
  }
  CHECK(contacts > grid_scenes_of_part);
  std::cout << "compared " << grid_scenes_of_part << " random scenes on a grid and " << generic_scenes_of_part
            << " generic ones, " << contacts << " contacts\n";
}

TEST_CASE("10,000 random scenes reach every case") {
  oracle::Coverage coverage;
  for (std::uint64_t seed = 0; seed < 400; ++seed) count(coverage, oracle::random_scene(seed));
  for (const std::size_t reached : coverage.kinds) CHECK(reached > 0);
  for (const std::size_t reached : coverage.closest_kinds) CHECK(reached > 0);
  CHECK(coverage.piercings > 0);
  CHECK(coverage.folds > 0);
  CHECK(coverage.degenerate_faces > 0);
  CHECK(coverage.warped_quads > 0);
  CHECK(coverage.parallel_edges > 0);
  CHECK(coverage.zero_distances > 0);
  CHECK(coverage.at_threshold > 0);
  CHECK(coverage.without_contact > 0);
}

}  // namespace graze::tests
