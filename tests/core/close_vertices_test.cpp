// Pairs of vertices of leaves beside each other, beside going through all pairs; to the last bit, since all
// coordinates are small multiples of a power of two and limits are met exactly.

#include "close_vertices.hpp"

#include <algorithm>
#include <graze/instruction_set.hpp>
#include <iostream>
#include <limits>
#include <utility>
#include <vector>

#include "core/comparison.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/model_shape.hpp"
#include "support/random_scenes.hpp"

namespace graze::tests {
namespace {

using VertexPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

struct Leaf {
  const Region* region;
  Box box;
};

std::vector<Leaf> leaves_of(const Surface& surface) {
  std::vector<Leaf> leaves;
  for (const Region& region : surface.mesh().regions().regions())
    if (region.is_leaf()) leaves.push_back({&region, surface.box_now(region, RefitOf::vertices)});
  return leaves;
}

struct Found {
  VertexPairs pairs;
  std::size_t discarded = 0;

  friend bool operator==(const Found&, const Found&) = default;
};

/// By all pairs of leaves, those of one leaf of a one after the other.
Found close_in_leaves(const Surface& a, const Surface& b, double limit, CloseVerticesScratch& scratch) {
  DecisionCount count;
  const SurfacePair pair{a, b, count};
  std::vector<ContactName> names;
  CloseVertices close(pair, limit, scratch, names);
  const auto leaves_a = leaves_of(a);
  const auto leaves_b = leaves_of(b);
  for (const Leaf& leaf_a : leaves_a)
    for (const Leaf& leaf_b : leaves_b) close.add({*leaf_a.region, leaf_a.box}, {*leaf_b.region, leaf_b.box});
  close.finish();
  Found found;
  for (const ContactName& name : names)
    found.pairs.emplace_back(name.a().feature.index, name.b().feature.index);
  std::sort(found.pairs.begin(), found.pairs.end());
  found.discarded = count.discarded_in_float;
  return found;
}

VertexPairs close_pairs(const Surface& a, const Surface& b, double limit) {
  VertexPairs pairs;
  for (std::uint32_t i = 0; i < a.mesh().vertex_count(); ++i)
    for (std::uint32_t j = 0; j < b.mesh().vertex_count(); ++j)
      if ((a.position(i) - b.position(j)).squaredNorm() < limit * limit) pairs.emplace_back(i, j);
  return pairs;
}

/// With every instruction set; how many pairs.
std::size_t check(const Surface& a, const Surface& b, double limit, CloseVerticesScratch& scratch) {
  const VertexPairs expected = close_pairs(a, b, limit);
  const InstructionSet before = instruction_set();
  use_instruction_set(InstructionSet::scalar);
  const Found first = close_in_leaves(a, b, limit, scratch);
  CHECK(first.pairs == expected);
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    INFO(to_string(set));
    CHECK(close_in_leaves(a, b, limit, scratch) == first);
  }
  use_instruction_set(before);
  return expected.size();
}

constexpr double step = 0x1p-6;

oracle::Shape on_grid(const oracle::Shape& shape, const Eigen::Vector3d& offset) {
  return snapped(mapped(shape, 1, offset), step);
}

void read_in_float(Surface& surface) {
  std::vector<Eigen::Vector3f> floats;
  for (std::uint32_t vertex = 0; vertex < surface.mesh().vertex_count(); ++vertex)
    floats.push_back(surface.position(vertex).cast<float>());
  surface.set_positions(floats);
}

}  // namespace

TEST_CASE("close vertices: those of leaves beside each other are all found") {
  CloseVerticesScratch scratch;
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    oracle::Random random(seed);
    const auto sphere = [&](const Eigen::Vector3d& offset) {
      return on_grid(wobbled(shape_of(models::sphere(20, 12)), 0.1, random.below(1000)), offset);
    };
    Surface a = surface_of(sphere({0, 0, 0}));
    Surface b = surface_of(sphere({random.between(-1, 1), random.between(-0.2, 0.2), 1.5}));
    if (seed % 2 == 0) read_in_float(b);
    if (seed % 3 == 0) read_in_float(a);
    const double limits[] = {0, 5 * step, 13 * step, 3, std::numeric_limits<double>::infinity()};
    compared += check(a, b, limits[seed % 5], scratch);
  }
  CHECK(compared > 100000);
  std::cout << "compared " << compared << " close vertices\n";
}

TEST_CASE("close vertices: leaves of more vertices than are compared at once") {
  CloseVerticesScratch scratch;
  // Coincident vertices are in one leaf.
  const Surface point = surface_of(mapped(shape_of(models::sheet(30, 30, 1, 1)), 0, {0, 0, 0}));
  const Surface other = surface_of(mapped(shape_of(models::sheet(26, 26, 1, 1)), 0, {3 * step, 0, 4 * step}));
  const std::size_t all = std::size_t{point.mesh().vertex_count()} * other.mesh().vertex_count();
  CHECK(other.mesh().vertex_count() > CloseVerticesScratch::most_beside);
  CHECK(check(point, other, 5 * step, scratch) == 0);
  CHECK(check(point, other, 6 * step, scratch) == all);
  const Surface sheet = surface_of(on_grid(shape_of(models::sheet(30, 30, 1, 1)), {-0.5, -0.5, 0}));
  CHECK(check(sheet, other, 20 * step, scratch) > 1000);
  CHECK(check(other, sheet, 20 * step, scratch) > 1000);
  // Many leaves beside one, together more than are compared at once.
  CHECK(check(sheet, sheet, 1, scratch) > 100000);
}

}  // namespace graze::tests
