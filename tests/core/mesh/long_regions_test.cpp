// Long faces across the axes: which regions count as long, what their boxes hold and bound, and that answers
// are those of brute force. And hubs, where very many faces meet: who owns these faces.

#include "core/mesh/long_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/comparison.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/oriented_box.hpp"
#include "core/surface/surface.hpp"
#include "pair/bounds.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"
#include "support/real.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

/// A square in strips from one side to the other, as triangles or as quads.
Shape strips(std::uint32_t count, bool as_quads) {
  Shape shape;
  for (const double x : {-1, 1})
    for (std::uint32_t j = 0; j <= count; ++j) shape.positions.emplace_back(x, 2.0 * j / count - 1, 0);
  for (std::uint32_t j = 0; j < count; ++j) {
    const std::uint32_t other = count + 1 + j;
    if (as_quads) {
      shape.faces.push_back({j, other, other + 1, j + 1});
    } else {
      shape.faces.push_back({j, other, other + 1});
      shape.faces.push_back({j, other + 1, j + 1});
    }
  }
  return shape;
}

/// A fan about a hub, which is the first corner of each face and the lowest vertex.
Shape fan(std::uint32_t count) {
  Shape shape;
  shape.positions.emplace_back(0, 0, 0);
  for (std::uint32_t j = 0; j < count; ++j) {
    const double angle = 6.28 * j / count;
    shape.positions.emplace_back(std::cos(angle), std::sin(angle), 0.1 * std::sin(3 * angle));
  }
  for (std::uint32_t j = 0; j < count; ++j) shape.faces.push_back({0, 1 + j, 1 + (j + 1) % count});
  return shape;
}

enum Family : std::uint64_t { plain, minute, huge, far, flat, in_one_point, family_count };

Shape now_of(Family family, const Shape& rest, std::uint64_t seed) {
  Shape now = turned(wobbled(rest, 0.05, seed), seed);
  if (family == minute) return mapped(now, 0x1p-110, Vector3d::Zero());
  if (family == huge) return mapped(now, 0x1p110, Vector3d::Zero());
  if (family == far) return mapped(now, 1, {0x1p30, -0x1p35, 0x1p33});
  if (family == flat)
    for (Vector3d& point : now.positions) point.z() = point.y() = 2 * point.x();
  if (family == in_one_point)
    for (Vector3d& point : now.positions) point = Vector3d(0.1, 0.2, 0.3);
  return now;
}

using Points = std::vector<Vector3d>;

/// Some corners of the faces that a region owns, and some points between them.
Points points_of(const Surface& surface, std::uint32_t region, Random& random) {
  const IndexedMesh& mesh = surface.mesh();
  Points points;
  const auto faces = mesh.regions().faces(mesh.regions().region(region));
  for (int i = 0; i < 12 && !faces.empty(); ++i) {
    const std::uint32_t face = faces[random.below(static_cast<std::uint32_t>(faces.size()))];
    Vector3d sum = Vector3d::Zero();
    double shares = 0;
    for (const std::uint32_t corner : mesh.face(face)) {
      points.push_back(surface.position(corner));
      const double share = random.between(0.1, 1);
      sum += share * surface.position(corner);
      shares += share;
    }
    points.emplace_back(sum / shares);
  }
  return points;
}

/// How far a point sticks out of a box, along any of its axes.
Real outside(const OrientedBox& box, const Vector3d& point) {
  Real most = -1;
  for (int axis = 0; axis < 3; ++axis) {
    Real at = -static_cast<Real>(box.middle[axis]);
    for (int k = 0; k < 3; ++k)
      at += static_cast<Real>(box.axes(axis, k)) *
            (static_cast<Real>(point[k]) - static_cast<Real>(box.origin[k]));
    most = std::max(most, std::abs(at) - static_cast<Real>(box.half[axis]));
  }
  return most;
}

/// Checks that the bounds of all pairs of long regions and others are not above the distance of any points.
std::size_t check_bounds(const Surface& a, const Surface& b, Random& random) {
  const RegionBounds bounds(a, b, RefitOf::faces);
  std::size_t helped = 0;
  for (const LongRegions::LongRegion& each : a.mesh().long_regions().all()) {
    const Points of_a = points_of(a, each.region, random);
    for (std::uint32_t region = 0; region < b.mesh().regions().region_count(); ++region) {
      const double lower = bounds.lower({each.region, region});
      helped += lower > lower_distance(a.face_boxes()[each.region], b.face_boxes()[region]) ? 1U : 0U;
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3d& point_b : points_of(b, region, random))
        for (const Vector3d& point_a : of_a) least = std::min(least, (point_b - point_a).squaredNorm());
      REQUIRE(lower <= std::sqrt(least) * (1 + 0x1p-45));
    }
  }
  return helped;
}

Shape ball(double size, std::uint64_t seed) {
  return turned(mapped(shape_of(models::sphere(6, 3)), size, Vector3d::Zero()), seed);
}

}  // namespace

TEST_CASE("long regions: leaves of strips and their parents, and none of ordinary surfaces") {
  for (const bool as_quads : {false, true}) {
    const auto mesh = mesh_of(strips(130, as_quads));
    const LongRegions& all = indexed(*mesh).long_regions();
    CHECK(all.count() > 8);
    CHECK(all.index_of(0) == all.count() - 1);
    std::uint32_t last = indexed(*mesh).regions().region_count();
    for (std::uint32_t index = 0; index < all.count(); ++index) {
      const std::uint32_t region = all.all()[index].region;
      CHECK(region < last);
      CHECK(all.index_of(region) == index);
      last = region;
    }
  }
  for (const NamedShape& model : paper_models()) {
    INFO(model.name);
    CHECK(indexed(*mesh_of(model.shape)).long_regions().empty());
  }
}

TEST_CASE("oriented boxes: they hold what a region owns, and bound its distance from others") {
  std::size_t helped = 0;
  for (std::uint64_t seed = 0; seed < 2 * family_count; ++seed) {
    const auto family = static_cast<Family>(seed % family_count);
    INFO("seed " << seed << ", family " << family);
    const Shape rest = strips(130, seed % 2 == 1);
    Random random(seed);
    const Surface a = surface_of({rest, now_of(family, rest, seed)});
    const LongRegions& all = a.mesh().long_regions();
    REQUIRE(a.oriented_boxes().size() == all.count());
    for (std::uint32_t index = 0; index < all.count(); ++index)
      for (const std::uint32_t face :
           a.mesh().regions().faces(a.mesh().regions().region(all.all()[index].region)))
        for (const std::uint32_t corner : a.mesh().face(face))
          REQUIRE(outside(a.oriented_boxes()[index], a.position(corner)) <= 0);
    const Surface b = surface_of({ball(1, seed), now_of(family, ball(0.3, seed), seed + 1)});
    helped += check_bounds(a, b, random);
    const Surface other = surface_of({rest, now_of(family, rest, seed + 7)});
    helped += check_bounds(a, other, random);
  }
  CHECK(helped > 100);
}

TEST_CASE("axes through points: square to each other, wherever the points are") {
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    const double size = std::ldexp(1.0, static_cast<int>(random.below(200)) - 100);
    const Vector3d first = random.vector(-1, 1) * size;
    const Vector3d second = i % 7 == 0 ? first : Vector3d(first + random.vector(-1, 1) * size);
    const int halvings = static_cast<int>(random.below(70));
    const Vector3d off_line = random.vector(-1, 1) * std::ldexp(size, -halvings);
    const Vector3d third =
        i % 5 == 0 ? second : Vector3d(first + (second - first) * random.between(-1, 2) + off_line);
    const Eigen::Matrix3d axes = axes_through({first, second, third});
    CHECK((axes * axes.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 0x1p-47);
    if (first != second) CHECK(axes.row(0).dot(second - first) > 0);
  }
}

TEST_CASE("long faces: answers are those of brute force, wherever they lie") {
  Comparison all;
  for (std::uint64_t seed = at_full_effort ? 0 : 2; seed < 4; ++seed) {
    INFO("seed " << seed);
    const Shape rest = strips(130, seed % 2 == 1);
    const Shape ground = turned(wobbled(rest, seed % 3 == 0 ? 0 : 0.02, seed), seed);
    Random random(seed);
    const Shape moved = mapped(ball(0.1, seed), 1, random.vector(-0.3, 0.3));
    const double threshold = 0.05;
    for (const bool is_first : {true, false}) {
      const Body a = is_first ? Body(rest, ground) : Body(moved);
      const Body b = is_first ? Body(moved) : Body(rest, ground);
      Comparison comparison = compare_surfaces(a, b, threshold);
      comparison.add(compare_nearest(a, b, threshold));
      CHECK(comparison.difference.empty());
      all.add(comparison);
    }
  }
  CHECK(all.contacts > 50);
}

TEST_CASE("long faces: steps with bounds of earlier ones answer as a search that knows nothing") {
  const Shape rest = strips(260, false);
  const Shape small = mapped(ball(0.1, 3), 1, {0.2, 0.1, 0.12});
  for (const ContactDetail detail :
       {ContactDetail::none, ContactDetail::closest, ContactDetail::features, ContactDetail::nearest}) {
    Surface a = surface_of(rest);
    Surface b = surface_of(small);
    LeafFront front;
    PairDetector detector;
    PairDetector of_nothing;
    for (int step = 0; step < 30; ++step) {
      const double angle = 0.05 * step;
      Shape now = wobbled(rest, 0.01, static_cast<std::uint64_t>(step) / 4);
      for (Vector3d& point : now.positions)
        point = Vector3d(std::cos(angle) * point.x() - std::sin(angle) * point.y(),
                         std::sin(angle) * point.x() + std::cos(angle) * point.y(), point.z());
      REQUIRE(a.set_positions(now.positions).taken());
      REQUIRE(b.set_positions(mapped(small, 1, {0, 0, -0.006 * step}).positions).taken());
      if (step % 5 == 0) a.refit_faces();
      if (step % 7 == 0) b.refit_faces();
      INFO("detail " << static_cast<int>(detail) << ", step " << step);
      PairQuery query = query_of(detail, 0.03);
      query.slack = 0.01;
      query.front_limit = 1000;
      PairAnswer answer;
      PairAnswer afresh;
      PairCounters counters;
      LeafFront no_front;
      detector.detect(a, b, query, front, answer, counters);
      of_nothing.detect(a, b, query, no_front, afresh, counters);
      check_same(answer, afresh);
    }
  }
}

TEST_CASE("hubs: the leaf of a hub does not own the faces about it, and answers stay right") {
  const Shape shape = fan(700);
  const auto mesh = mesh_of(shape);
  const RegionTree& tree = indexed(*mesh).regions();
  std::vector<int> owners(shape.faces.size(), 0);
  for (std::uint32_t index = 0; index < tree.region_count(); ++index) {
    const Region& leaf = tree.region(index);
    if (!leaf.is_leaf()) continue;
    CHECK(leaf.face_count <= leaf.vertex_count);
    CHECK(leaf.edge_count <= 3 * leaf.vertex_count);
    const auto vertices = tree.vertices(leaf);
    for (const std::uint32_t face : tree.faces(leaf)) {
      ++owners[face];
      CHECK(std::find(vertices.begin(), vertices.end(), shape.faces[face][1]) != vertices.end());
    }
  }
  CHECK(std::all_of(owners.begin(), owners.end(), [](int count) { return count == 1; }));
  const Body small = mapped(ball(0.15, 4), 1, {0.4, 0.3, 0.05});
  Comparison comparison = compare_surfaces(shape, small, 0.02);
  comparison.add(compare_nearest(small, shape, 0.02));
  CHECK(comparison.difference.empty());
  CHECK(comparison.contacts > 50);
}

}  // namespace graze::tests
