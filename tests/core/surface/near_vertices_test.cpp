// Pairs of vertices, and the closest ones, of surfaces that meet in one place, of those that lie along each
// other, small and large, far away and of any scale, beside going through all pairs.

#include "vertices/near_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/instruction_set.hpp>
#include <iostream>
#include <limits>
#include <utility>
#include <vector>

#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/model_shape.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using VertexPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The result of a search through all pairs of used vertices.
struct AllPairs {
  VertexPairs near;
  double nearest = infinity;
};

/// The near ones are closer than the limit, in the order of contacts. Distances are far enough from it that
/// rounding does not matter, or exact.
AllPairs all_pairs(const Surface& a, const Surface& b, double limit) {
  std::array<std::vector<double>, 3> of_b;
  std::vector<std::uint32_t> number;
  for (std::uint32_t j = 0; j < b.mesh().vertex_count(); ++j) {
    if (!b.mesh().is_used(j)) continue;
    number.push_back(j);
    const Eigen::Vector3d position = b.position(j);
    for (std::size_t axis = 0; axis < 3; ++axis)
      of_b[axis].push_back(position[static_cast<Eigen::Index>(axis)]);
  }
  AllPairs all;
  for (std::uint32_t i = 0; i < a.mesh().vertex_count(); ++i) {
    if (!a.mesh().is_used(i)) continue;
    const Eigen::Vector3d from = a.position(i);
    for (std::size_t k = 0; k < number.size(); ++k) {
      const double x = from.x() - of_b[0][k], y = from.y() - of_b[1][k], z = from.z() - of_b[2][k];
      const double distance = std::sqrt(x * x + y * y + z * z);
      if (distance < limit) all.near.emplace_back(i, number[k]);
      all.nearest = std::min(all.nearest, distance);
    }
  }
  return all;
}

VertexPairs pairs_of(const PairAnswer& answer) {
  VertexPairs pairs;
  for (const Contact& contact : answer.contacts)
    pairs.emplace_back(contact.feature_a.index, contact.feature_b.index);
  return pairs;
}

/// As one piece and cut into slices.
PairAnswer detect_in_slices(const Surface& a, const Surface& b, const PairQuery& query) {
  LargePair large;
  PairDetector detector;
  PairCounters counters;
  LeafFront front;
  PairAnswer answer;
  large.begin(a, b, query, front, answer);
  while (!large.advance(detector, counters))
    for (std::size_t i = large.slice_count(); i-- > 0;) large.run_slice(i, detector, counters);
  return answer;
}

/// Expects these pairs of every search with every instruction set.
void check_answers(const Surface& a, const Surface& b, double limit, const VertexPairs& expected,
                   double nearest) {
  const InstructionSet before = instruction_set();
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    INFO(to_string(set));
    for (const PairAnswer& answer : {detect(a, b, query_of(ContactDetail::vertices, limit)),
                                     detect_in_slices(a, b, query_of(ContactDetail::vertices, limit))}) {
      CHECK(pairs_of(answer) == expected);
      CHECK(answer.in_contact == !expected.empty());
      CHECK(answer.distance.upper == Approx(nearest).epsilon(1e-12));
    }
  }
  use_instruction_set(before);
}

/// A large surface once more, with stretches in place of blocks.
Surface in_part(const Surface& surface) {
  Surface part(surface.shared_mesh());
  REQUIRE(part.set_positions(surface.positions()).taken());
  part.make_stretches();
  REQUIRE_FALSE(part.has_blocks());
  return part;
}

/// How many pairs. Where there are none the nearest is asked for too.
std::size_t check(const Surface& a, const Surface& b, double limit) {
  const auto [expected, nearest] = all_pairs(a, b, limit);
  check_answers(a, b, limit, expected, nearest);
  if (a.mesh().has_stretches()) check_answers(in_part(a), b, limit, expected, nearest);
  if (b.mesh().has_stretches()) check_answers(a, in_part(b), limit, expected, nearest);
  if (a.mesh().has_stretches() && b.mesh().has_stretches())
    check_answers(in_part(a), in_part(b), limit, expected, nearest);
  return expected.size();
}

void read_in_float(Surface& surface) {
  std::vector<Eigen::Vector3f> floats;
  for (std::uint32_t vertex = 0; vertex < surface.mesh().vertex_count(); ++vertex)
    floats.emplace_back(surface.position(vertex).cast<float>());
  surface.set_positions(floats);
  surface.make_blocks();
}

/// A grid of the size in the plane, in waves.
oracle::Shape cloth(std::uint32_t rows, double size, std::uint64_t seed) {
  return wobbled(shape_of(models::sheet(rows, rows, size, size)), 0.01 * size, seed);
}

/// Vertices under other numbers.
oracle::Shape renumbered(const oracle::Shape& shape, std::uint64_t seed) {
  oracle::Random random(seed);
  std::vector<std::uint32_t> number(shape.positions.size());
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    number[i] = i;
    std::swap(number[i], number[random.below(i + 1)]);
  }
  oracle::Shape other = shape;
  for (std::size_t i = 0; i < number.size(); ++i) other.positions[number[i]] = shape.positions[i];
  for (auto& face : other.faces)
    for (std::uint32_t& corner : face) corner = number[corner];
  return other;
}

}  // namespace

TEST_CASE("near vertices: small surfaces of all kinds, in either precision") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    oracle::Random random(seed);
    // Some of a soup's vertices are unused.
    Surface a = surface_of(random_soup(seed, 40 + random.below(100), 80));
    const Eigen::Vector3d away{random.between(-1.2, 1.2), random.between(-0.2, 0.2), 0};
    Surface b = surface_of(mapped(random_soup(seed + 1, 40 + random.below(100), 80), 1, away));
    if (seed % 2 == 0) read_in_float(b);
    if (seed % 3 == 0) read_in_float(a);
    const double limits[] = {0, 0.07, 0.31, 5, infinity};
    compared += check(a, b, limits[seed % 5] * (1 + 0x1p-20));
  }
  CHECK(compared > 10000);
  std::cout << "compared " << compared << " pairs of vertices\n";
}

TEST_CASE("near vertices: limits that are met exactly, at any scale and place") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < repeats(60); ++seed) {
    oracle::Random random(seed);
    const double step = std::ldexp(1.0, static_cast<int>(seed % 3) * 90 - 96);
    const double away = seed % 4 == 0 ? 0x1p20 : 0;  // exact in double, and in float it is not
    const auto sphere = [&](const Eigen::Vector3d& offset) {
      oracle::Shape shape =
          snapped(mapped(wobbled(shape_of(models::sphere(20, 12)), 0.1, random.below(1000)), 64, offset), 1);
      for (Eigen::Vector3d& position : shape.positions)
        position = step * (position + Eigen::Vector3d(away, away, 0));
      return shape;
    };
    Surface a = surface_of(sphere({0, 0, 0}));
    Surface b = surface_of(sphere({random.between(-60, 60), random.between(-12, 12), 96}));
    if (away == 0 && seed % 2 == 0) read_in_float(b);
    if (away == 0 && seed % 3 == 0) read_in_float(a);
    const double limits[] = {5, 13, 29, 192};
    compared += check(a, b, limits[seed % 4] * step);
  }
  CHECK(compared > repeats(100'000));
  std::cout << "compared " << compared << " pairs of vertices on a grid\n";
}

TEST_CASE("near vertices: large surfaces that meet in a corner, and lie along each other") {
  Surface a = surface_of(cloth(100, 1, 1));
  const Surface b = surface_of(mapped(cloth(95, 1, 2), 1, {0.8, 0.85, 0.005}));
  CHECK(check(a, b, 0.03) > 100);
  read_in_float(a);
  CHECK(check(a, b, 0.03) > 100);
  const Surface c = surface_of(cloth(70, 1, 4));
  const Surface d = surface_of(mapped(cloth(70, 1, 5), 1, {0, 0, 0.004}));
  CHECK(check(c, d, 0.03) > 1000);
  // Few vertices, all of them near all others.
  CHECK(check(surface_of(cloth(40, 0.01, 6)), surface_of(cloth(40, 0.01, 7)), 0.004) > 1000);
  // Nothing nearer than the limit: only the closest.
  CHECK(check(a, surface_of(mapped(cloth(60, 1, 8), 1, {0.3, 0.2, 0.4})), 0.03) == 0);
}

TEST_CASE("near vertices: large surfaces whose vertices are numbered in any order, one of them exploded") {
  oracle::Shape sheet = renumbered(cloth(100, 1, 11), 5);
  Surface other = surface_of(mapped(cloth(95, 1, 12), 1, {0.9, 0.9, 0.005}));
  CHECK(check(surface_of(sheet), other, 0.03) > 50);
  sheet.positions[4000] = Eigen::Vector3d(1e30, -1e29, 1e30);
  CHECK(check(surface_of(sheet), other, 0.03) > 50);
  CHECK(check(other, surface_of(sheet), 0.03) > 50);
}

TEST_CASE("near vertices: a large surface and a small one far below its size") {
  const Surface ground = surface_of(cloth(100, 1, 3));
  const Surface pebble = surface_of(mapped(shape_of(models::sphere(12, 8)), 0.02, {0.4, 0.3, 0.01}));
  CHECK(check(ground, pebble, 0.01) > 10);
  CHECK(check(pebble, ground, 0.01) > 10);
}

TEST_CASE("near vertices: a vertex that exploded costs the rest no precision") {
  const oracle::Shape sheet = cloth(60, 1, 1);
  const Surface below = surface_of(mapped(cloth(60, 1, 2), 1, {0.1, 0.2, 0.02}));
  const auto compared = [](const Surface& a, const Surface& b, double limit) {
    PairDetector detector;
    PairCounters counters;
    PairAnswer answer;
    detector.detect(a, b, query_of(ContactDetail::vertices, limit), answer, counters);
    return counters.discarded_in_float;
  };
  for (const std::size_t vertex : {std::size_t{0}, sheet.positions.size() / 2, sheet.positions.size() - 1})
    for (const double limit : {0.03, 0.001}) {
      INFO("vertex " << vertex << ", limit " << limit);
      oracle::Shape exploded = sheet;
      exploded.positions[vertex] = Eigen::Vector3d(1e30, -1e29, 1e30);
      check(surface_of(exploded), below, limit);
      check(below, surface_of(exploded), limit);
      const std::uint64_t before = compared(surface_of(sheet), below, limit);
      CHECK(before > 1000);
      // The block of the vertex that exploded is compared with all others.
      const std::uint64_t most =
          before + before / 4 + std::size_t{2} * VertexBlocks::block_size * sheet.positions.size();
      CHECK(compared(surface_of(exploded), below, limit) < most);
      CHECK(compared(below, surface_of(exploded), limit) < most);
    }
}

TEST_CASE("near vertices: of equally near ones the lowest, and none beyond the reach") {
  // Two boxes face to face: four pairs of corners at one distance.
  const Surface a = surface_of(box({0, 0, 0}, {1, 1, 1}));
  const Surface b = surface_of(box({1.5, 0, 0}, {1, 1, 1}));
  PairQuery query = query_of(ContactDetail::vertices, 0.25);
  const PairAnswer answer = detect(a, b, query);
  CHECK(answer.listed);
  CHECK(answer.distance.lower == 0.5);
  CHECK(answer.distance.upper == 0.5);
  CHECK(answer.witness.feature_a.index == 1);
  CHECK(answer.witness.feature_b.index == 0);
  query.reach = 0.5;
  CHECK_FALSE(detect(a, b, query).listed);
  query.reach = std::nextafter(0.5, 1);
  CHECK(detect(a, b, query).listed);
  // A vertex in common, and no threshold: distance 0 is not below it.
  const Surface c = surface_of(box({1, 1, 1}, {1, 1, 1}));
  const PairAnswer touching = detect(a, c, query_of(ContactDetail::vertices, 0));
  CHECK_FALSE(touching.in_contact);
  CHECK(touching.listed);
  CHECK(touching.distance.upper == 0);
  CHECK(touching.witness.feature_a.index == 7);
  CHECK(touching.witness.feature_b.index == 0);
}

TEST_CASE("near vertices: stop where the budget does") {
  const Surface a = surface_of(cloth(100, 1, 1));
  const Surface b = surface_of(mapped(cloth(95, 1, 2), 1, {0.8, 0.85, 0.005}));
  PairQuery query = query_of(ContactDetail::vertices, 0.03);
  PairDetector detector;
  const auto run = [&](PairCounters& counters) {
    PairAnswer answer;
    detector.detect(a, b, query, answer, counters);
    return answer;
  };
  PairCounters all;
  const PairAnswer expected = run(all);
  const std::uint64_t whole = all.region_pairs_tested;
  CHECK(whole > 20);
  for (std::uint64_t limit = 0; limit <= whole + 1; ++limit) {
    query.work_limit = limit;
    PairCounters counters;
    const PairAnswer answer = run(counters);
    CHECK(answer.complete == (limit >= whole));
    CHECK(counters.region_pairs_tested == std::min(limit, whole));
    CHECK(answer.contacts.size() == (limit < whole ? 0 : expected.contacts.size()));
  }
}

}  // namespace graze::tests
