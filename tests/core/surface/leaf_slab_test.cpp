// Slabs of leaves, in long double: what they are to hold, and that leaves which they say to be apart are.

#include "surface/leaf_slab.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/comparison.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"
#include "support/real.hpp"
#include "surface/per_leaf_cache.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

enum Family : std::uint64_t { plain, minute, huge, far, soup, in_line, family_count };

/// A wavy sheet of 20 x 20 quads, at a height.
Shape sheet(double height, std::uint64_t seed) {
  Shape shape;
  constexpr std::uint32_t side = 21;
  for (std::uint32_t i = 0; i < side * side; ++i)
    shape.positions.emplace_back(i % side, i / side, height);  // NOLINT(bugprone-integer-division)
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t first = y * side + x;
      shape.faces.push_back({first, first + 1, first + side + 1, first + side});
    }
  return wobbled(shape, 0.5, seed);
}

Shape shape_of(Family family, double height, std::uint64_t seed) {
  if (family == soup) return random_soup(seed, 60, 40);
  Shape shape = sheet(height, seed);
  if (family == minute) return mapped(shape, 0x1p-110, Vector3d::Zero());
  if (family == huge) return mapped(shape, 0x1p110, Vector3d::Zero());
  if (family == far) return mapped(shape, 1, {0x1p30, -0x1p35, 0x1p33});
  if (family == in_line)
    for (Vector3d& point : shape.positions) point.y() = point.z() = 0;
  return shape;
}

std::vector<Vector> corners_of(const Surface& surface, const Region& leaf) {
  const RegionTree& tree = surface.mesh().regions();
  std::vector<Vector> corners;
  for (const std::uint32_t vertex : tree.vertices(leaf))
    corners.emplace_back(surface.position(vertex).cast<Real>());
  for (const std::uint32_t vertex : tree.border(leaf))
    corners.emplace_back(surface.position(vertex).cast<Real>());
  return corners;
}

struct Leaf {
  LeafSlab slab;
  Vector3d middle;
  std::vector<Vector> corners;
};

std::vector<Leaf> leaves_of(const Surface& surface) {
  std::vector<Leaf> leaves;
  for (const Region& region : surface.mesh().regions().regions())
    if (region.is_leaf())
      leaves.push_back({slab_of(surface, region), surface.middle(region), corners_of(surface, region)});
  return leaves;
}

/// Whether it is no slab of everything.
bool check_holds(const Leaf& leaf) {
  const LeafSlab& slab = leaf.slab;
  if (!slab.is_known()) return false;
  const Vector normal = slab.normal.cast<Real>();
  REQUIRE(normal.norm() <= 1);
  REQUIRE(normal.norm() > 1 - 0x1p-20L);
  for (const Vector& corner : leaf.corners) {
    const Vector way = corner - leaf.middle.cast<Real>();
    REQUIRE(normal.dot(way) >= static_cast<Real>(slab.low));
    REQUIRE(normal.dot(way) <= static_cast<Real>(slab.high));
    REQUIRE(way.norm() <= static_cast<Real>(slab.radius));
  }
  return true;
}

/// How far corners are apart along a direction.
Real gap_along(const Vector& direction, const Leaf& a, const Leaf& b) {
  const auto range = [&](const Leaf& leaf) {
    std::pair<Real, Real> found{direction.dot(leaf.corners.front()), direction.dot(leaf.corners.front())};
    for (const Vector& corner : leaf.corners) {
      found.first = std::min(found.first, direction.dot(corner));
      found.second = std::max(found.second, direction.dot(corner));
    }
    return found;
  };
  const auto [low_a, high_a] = range(a);
  const auto [low_b, high_b] = range(b);
  return std::max(low_a - high_b, low_b - high_a) / direction.norm();
}

/// Whether they are said to be apart. If so, the normal of one separates them.
bool check_apart(const Leaf& a, const Leaf& b, double distance) {
  if (!are_apart(a.slab, b.slab, b.middle - a.middle, distance)) return false;
  const Real gap =
      std::max(gap_along(a.slab.normal.cast<Real>(), a, b), gap_along(b.slab.normal.cast<Real>(), a, b));
  REQUIRE(gap > static_cast<Real>(distance));
  return true;
}

/// Checks the bound of the distance of a point against what three corners span. Returns whether it is
/// positive.
bool check_lower(const Leaf& leaf, const Vector3d& point, Random& random) {
  const double lower = lower_squared(leaf.slab, point - leaf.middle);
  const auto corner = [&] {
    return leaf.corners[random.below(static_cast<std::uint32_t>(leaf.corners.size()))];
  };
  for (int i = 0; i < 20; ++i) {
    const Real first = random.between(0, 1);
    const Real second = random.between(0, 1) * static_cast<double>(1 - first);
    const Vector held = corner() * first + corner() * second + corner() * (1 - first - second);
    REQUIRE(static_cast<Real>(lower) <= (held - point.cast<Real>()).squaredNorm() * (1 + 0x1p-50L));
  }
  return lower > 0;
}

Surface in_floats(const Surface& surface) {
  Surface other(surface.shared_mesh());
  std::vector<Eigen::Vector3f> positions;
  for (std::uint32_t vertex = 0; vertex < surface.mesh().vertex_count(); ++vertex)
    positions.emplace_back(surface.position(vertex).cast<float>());
  REQUIRE(other.set_positions(positions).taken());
  return other;
}

}  // namespace

TEST_CASE("leaf slabs: they hold the corners, and what they say to be apart is") {
  std::size_t apart = 0;
  std::size_t all = 0;
  for (std::uint64_t family = 0; family < family_count; ++family) {
    std::size_t known = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Surface first = surface_of(shape_of(static_cast<Family>(family), 0, 2 * seed));
      const Surface second = surface_of(shape_of(static_cast<Family>(family), 1.6, 2 * seed + 1));
      for (const bool with_floats : {false, true}) {
        const auto a = leaves_of(with_floats ? in_floats(first) : first);
        const auto b = leaves_of(with_floats ? in_floats(second) : second);
        for (const Leaf& leaf : a) known += check_holds(leaf) ? 1U : 0U;
        for (const Leaf& leaf : b) known += check_holds(leaf) ? 1U : 0U;
        const double unit = first.box().max.x() / 20;
        for (const Leaf& leaf_a : a)
          for (const Leaf& leaf_b : b)
            for (const double distance : {0.0, 0.4 * unit, 1.2 * unit}) {
              const bool is_apart = check_apart(leaf_a, leaf_b, distance);
              if (family != plain || distance > 0) continue;
              ++all;
              apart += is_apart ? 1U : 0U;
            }
      }
    }
    INFO("family " << family);
    if (family == in_line)
      CHECK(known == 0);
    else
      CHECK(known > 0);
  }
  CHECK(apart > all / 2);
}

TEST_CASE("leaf slabs: no point is said to be further from a leaf than it is") {
  Random random(5);
  std::size_t positive = 0;
  for (std::uint64_t family = 0; family < family_count; ++family) {
    const Surface surface = surface_of(shape_of(static_cast<Family>(family), 0, family));
    const double unit = (surface.box().max - surface.box().min).maxCoeff() / 20;
    for (const Leaf& leaf : leaves_of(surface))
      for (const double away : {0.1, 1.0, 10.0, 1000.0})
        positive +=
            check_lower(leaf, leaf.middle + away * unit * random.vector(-1, 1), random) && family == plain
                ? 1U
                : 0U;
  }
  CHECK(positive > 100);
}

TEST_CASE("made of leaves: what is made of the same positions is kept, and made anew of others") {
  Surface surface = surface_of(sheet(0, 1));
  const Surface other = surface_of(sheet(0, 1));
  PerLeafCache<int> made;
  int count = 0;
  const auto value = [&](const Surface& of, std::size_t leaf) {
    made.begin(of);
    return made.of(leaf, [&] { return ++count; });
  };
  CHECK(value(surface, 3) == 1);
  CHECK(value(surface, 4) == 2);
  CHECK(value(surface, 3) == 1);
  CHECK(value(other, 3) == 3);
  CHECK(value(surface, 3) == 4);
  CHECK(value(surface, 4) == 5);
  REQUIRE(surface.set_positions(sheet(1, 1).positions).changed);
  CHECK(value(surface, 3) == 6);
  made.forget();
  CHECK(value(surface, 3) == 7);
}

}  // namespace graze::tests
