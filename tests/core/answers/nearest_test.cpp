// ContactDetail::nearest against brute force: random small scenes, from scratch and with a front of an
// earlier step, and real meshes where there are any.

#include <cmath>
#include <filesystem>
#include <iostream>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/mesh_files.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"
#include "support/reduce.hpp"

namespace graze::tests {
namespace {

constexpr std::uint64_t nearest_part_count = 5;
constexpr std::uint64_t nearest_grid_scenes = repeats(10'000) / nearest_part_count;
constexpr std::uint64_t nearest_generic_scenes = nearest_grid_scenes / 5;

std::string nearest_difference(const PairAnswer& answer, const Expected& expected,
                               const Tolerance& tolerance) {
  std::string text = difference_of(answer.contacts, expected.contacts, tolerance);
  text += difference_of(answer.distance, answer.witness, expected.distance, tolerance);
  if (answer.in_contact != expected.in_contact) text += "in contact or not is wrong\n";
  if (!answer.complete) text += "not complete\n";
  return text;
}

/// A query that keeps a front and a list of near features for some steps.
PairQuery query_for_steps(double threshold) {
  PairQuery query = query_of(ContactDetail::nearest, threshold);
  query.reach = threshold + 0.5;
  query.slack = 1;
  query.list_slack = 0.5;
  return query;
}

/// Asks of b in two other positions first, and then twice of the given ones, always with one front.
std::string difference_with_front(const TwoShapes& scene, const Expected& expected) {
  const Tolerance tolerance(scene.a, scene.b);
  const Surface a = surface_of(scene.a);
  Surface b = surface_of(scene.b);
  const PairQuery query = query_for_steps(scene.threshold);
  PairDetector detector;
  LeafFront front;
  PairAnswer answer;
  PairCounters counters;
  std::string text;
  for (const double way : {0.25, -0.125, 0.0, 0.0}) {
    REQUIRE(b.set_positions(mapped(scene.b, 1, {way, way / 2, -way}).positions).taken());
    detector.detect(a, b, query, front, answer, counters);
    if (way == 0 && answer.listed) text += nearest_difference(answer, expected, tolerance);
    if (way == 0 && answer.listed != (expected.in_contact || is_within(expected.distance, query.reach)))
      text += "listed or not is wrong\n";
  }
  return text.empty() ? text : "with a front: " + text;
}

std::string nearest_fault(const TwoShapes& scene) {
  const Expected expected = expected_of(scene.a, scene.b, scene.threshold, ContactDetail::nearest);
  const PairAnswer answer =
      detect(surface_of(scene.a), surface_of(scene.b), query_of(ContactDetail::nearest, scene.threshold));
  return nearest_difference(answer, expected, {scene.a, scene.b}) + difference_with_front(scene, expected);
}

/// Compares the scene of a seed. One that differs is reduced.
void check_nearest(std::uint64_t seed) {
  const oracle::RandomScene given = oracle::random_scene(seed);
  const TwoShapes scene{given.a, given.b, given.threshold};
  const std::string fault = nearest_fault(scene);
  if (!fault.empty())
    FAIL_CHECK("seed " << seed << ": " << fault << "reduced:\n" << reduced_text(scene, nearest_fault));
}

/// The path of a file of the shared data. It is empty where there is none, and says so.
std::string real_mesh_path(const std::string& file) {
  std::string path = std::string(GRAZE_SHARED_DATA) + "/" + file;
  if (std::filesystem::exists(path)) return path;
  std::cout << "skipped: there is no " << path << "\n";
  return {};
}

/// Compares at four distances. The largest is `apart` and `further`. Returns how many contacts that were.
std::size_t check_at_four_distances(const oracle::Shape& a, const oracle::Shape& b, double further) {
  const double apart = oracle::surface_distance(a, b).distance_up;
  std::size_t contacts = 0;
  for (const double threshold : {0.0, apart, std::nextafter(apart, 1e9), apart + further}) {
    INFO("threshold " << threshold);
    const Comparison comparison = compare_nearest(a, b, threshold);
    CHECK(comparison.difference == "");
    contacts += comparison.contacts;
  }
  return contacts;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("nearest: 10,000 random scenes are those of brute force, part", "",
                       ((int nearest_part), nearest_part), 0, 1, 2, 3, 4) {
  const FloatingPointScope scope;
  for (std::uint64_t i = 0; i < nearest_grid_scenes; ++i)
    check_nearest(2 * (nearest_part * nearest_grid_scenes + i) + 1);
  for (std::uint64_t i = 0; i < nearest_generic_scenes; ++i)
    check_nearest(2 * (nearest_part * nearest_generic_scenes + i));
}

TEST_CASE("nearest: surfaces in contact at the fold of a quad alone have one contact") {
  // The edge of a is nearest to the fold, from vertex 0 to vertex 3. Vertices and edges are further apart.
  const oracle::Shape a{{{0, 0, 0}, {-1, 1, 0}}, {{0, 1, 1}}};
  const oracle::Shape b{{{0, 0, 0.5}, {0, 0, 1}, {0, 0, 1}, {-1, 0, 0}}, {{0, 1, 3, 2}}};
  const auto closest = oracle::closest(a, b, 1);
  REQUIRE(closest.has_value());
  CHECK(closest->kind == ContactKind::EF);
  CHECK(oracle::nearest(a, b, 1)[0].distance > closest->distance);
  for (const double threshold : {0.41, 0.5, 1.0}) CHECK(nearest_fault({a, b, threshold}) == "");
  const auto at = [&](double threshold) {
    return detect(surface_of(a), surface_of(b), query_of(ContactDetail::nearest, threshold)).contacts;
  };
  REQUIRE(at(0.41).size() == 1);
  CHECK(at(0.41)[0].kind == ContactKind::EF);
  CHECK(at(0.41)[0].distance == closest->distance);
  CHECK(at(oracle::surface_distance(a, b).distance_down).empty());
  // Where something else is below the threshold, the fold is none.
  REQUIRE(at(1).size() > 1);
  for (const Contact& contact : at(1)) CHECK(contact.kind < ContactKind::EF);
}

TEST_CASE("nearest: generated surfaces of a few hundred faces") {
  const oracle::Shape ball = shape_of(models::sphere(14, 9));
  const oracle::Shape quad_ball = shape_of(models::sphere(12, 7, models::Faces::quads));
  const oracle::Shape sheet = shape_of(models::sheet(12, 10, 3, 3));
  std::size_t contacts = 0;
  const auto check = [&contacts](const Body& a, const Body& b, double threshold) {
    const Comparison comparison = compare_nearest(a, b, threshold);
    CHECK(comparison.difference == "");
    contacts += comparison.contacts;
  };
  check(ball, turned(ball, 1), 0.05);
  check(ball, mapped(quad_ball, 0.5, {0.1, 0.2, 0}), 0.3);
  check(sheet, mapped(quad_ball, 1, {0, 0, 1}), 0.05);
  check(sheet, mapped(sheet, 1, {0.125, 0, 0.0625}), 0.07);
  check(sheet, sheet, 0.01);
  check(wobbled(sheet, 0.1, 7), wobbled(sheet, 0.1, 8), 0.05);
  check({sheet, wobbled(sheet, 0.3, 9)}, {ball, mapped(ball, 0.5, {0, 0, 0.4})}, 0.05);
  check({ball, mapped(ball, 0, {1.05, 0, 0})}, ball, 0.1);
  CHECK(contacts > 1000);
  std::cout << "compared " << contacts << " nearest contacts of generated surfaces\n";
}

TEST_CASE("nearest: real cubes at four distances") {
  std::size_t contacts = 0;
  for (const std::string name : {"close", "far", "intersecting"}) {
    const std::string path = real_mesh_path("cubes/two-cubes-" + name + ".ply");
    if (path.empty()) return;
    INFO(path);
    const auto cubes = pieces_of(read_ply(path));
    REQUIRE(cubes.size() == 2);
    contacts += check_at_four_distances(cubes[0], cubes[1], 0.1);
    contacts += check_at_four_distances(cubes[0], wobbled(cubes[1], 0.05, 2), 0.1);
  }
  CHECK(contacts > 50);
}

TEST_CASE("nearest: real links of a chain at four distances") {
  const std::string path = real_mesh_path("bodies/chain__10-links.obj");
  if (path.empty()) return;
  const auto links = read_obj_objects(path);
  REQUIRE(links.size() == 10);
  std::size_t contacts = check_at_four_distances(links[0], links[1], 0.2);
  contacts += check_at_four_distances(wobbled(links[1], 0.1, 1), wobbled(links[2], 0.1, 2), 0.1);
  CHECK(contacts > 100);
}

}  // namespace graze::tests
