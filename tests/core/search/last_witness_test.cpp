// This test checks the nearest points that are remembered from earlier steps. They must never be nearer than
// the surfaces are, and no answer may depend on them.

#include "walk/last_witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "closest_features/closest_features.hpp"
#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"
#include "support/real.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

constexpr double infinity = std::numeric_limits<double>::infinity();

FeaturePiece random_piece(const IndexedMesh& mesh, Random& random) {
  const auto index = [&](std::uint32_t count) { return static_cast<std::uint32_t>(random.below(count)); };
  switch (random.below(4)) {
    case 0:
      return edge_piece(index(mesh.edge_count()));
    case 1:
      return vertex_piece(mesh.edge(index(mesh.edge_count()))[0]);
    default: {
      const std::uint32_t face = index(mesh.face_count());
      if (triangle_count(mesh, face) == 1) return face_piece(face, Piece::first);
      return face_piece(face, std::array{Piece::first, Piece::second, Piece::fold}[random.below(3)]);
    }
  }
}

/// The way from a point's first corner to it, exactly but for long double. Shares that are more than 1 in all
/// are brought to 1.
Vector way_to(const Surface& surface, const SurfacePoint& on) {
  std::array<Real, 2> share{static_cast<Real>(on.share[0]), static_cast<Real>(on.share[1])};
  const Real sum = share[0] + share[1];
  REQUIRE(share[0] >= 0);
  REQUIRE(share[1] >= 0);
  REQUIRE(sum <= 1 + 0x1p-22L);
  const Vector first = surface.position(on.corner[0]).cast<Real>();
  Vector way = Vector::Zero();
  for (std::uint32_t i = 1; i < on.size; ++i)
    way += (surface.position(on.corner[i]).cast<Real>() - first) * (share[i - 1] / std::max<Real>(sum, 1));
  return way;
}

/// Returns the distance of two points of surfaces at the present positions. It is calculated from differences
/// of positions: far from the origin a coordinate has no digits left for the small part.
Real distance_of(const Surface& a, const SurfacePoint& on_a, const Surface& b, const SurfacePoint& on_b) {
  const Vector between = b.position(on_b.corner[0]).cast<Real>() - a.position(on_a.corner[0]).cast<Real>();
  return (between + way_to(b, on_b) - way_to(a, on_a)).norm();
}

Shape random_shape(std::uint64_t seed) {
  const Shape soup = random_soup(seed, 30, 20);
  switch (seed % 4) {
    case 0:
      return mapped(soup, 0x1p-110, Vector3d::Zero());
    case 1:
      return mapped(soup, 0x1p100, Vector3d::Zero());
    case 2:
      return mapped(soup, 1, {0x1p40, -0x1p42, 3});
    default:
      return soup;
  }
}

/// Calls `check(pair, random)` often, with surfaces of all sizes and places.
template <typename Check>
void check_random_pairs(const Check& check) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Surface a = surface_of(random_shape(seed));
    const Surface b = surface_of(random_shape(seed + 4));
    DecisionCount count;
    for (int i = 0; i < 20; ++i) check(SurfacePair{a, b, count}, random);
  }
}

struct Moves {
  const char* name;
  Shape a;
  Shape b;
};

}  // namespace

TEST_CASE("last witness: it is never nearer than its points are, and hardly further") {
  std::size_t inner = 0;
  check_random_pairs([&](const SurfacePair& pair, Random& random) {
    const Surface& a = pair.a;
    const Surface& b = pair.b;
    const FeaturePiece piece = random_piece(a.mesh(), random);
    const auto name = FeaturePairKey::of(piece, random_piece(b.mesh(), random));
    // Any points will do: near the features or not.
    const auto point_of = [&](const Surface& surface) -> Vector3d {
      const Vector3d size = surface.box().max - surface.box().min;
      return surface.box().min + size.cwiseProduct(random.vector(0, 1));
    };
    const Vector3d point = point_of(a);
    const LastWitness witness = last_witness_of(pair, name, point, point_of(b));
    const Real truth = distance_of(a, witness.on_a, b, witness.on_b);
    const auto upper = static_cast<Real>(upper_distance(pair, witness, false));
    const Real size = (a.box().max - a.box().min).norm() + (b.box().max - b.box().min).norm();
    REQUIRE(upper >= truth);
    REQUIRE(upper <= truth * (1 + 0x1p-40L) + size * 0x1p-18L);
    const bool are_vertices = witness.on_a.size == 1 && witness.on_b.size == 1;
    REQUIRE((upper_distance(pair, witness, true) == infinity) != are_vertices);
    inner += witness.on_a.share[0] > 0 && witness.on_a.share[0] < 1 ? 1U : 0U;
  });
  CHECK(inner > 1000);
}

TEST_CASE("upper distances: they are above the distance of features, by 2^-40 of it at most") {
  check_random_pairs([](const SurfacePair& pair, Random& random) {
    const IndexedMesh& mesh = pair.a.mesh();
    const FeaturePiece vertex = vertex_piece(mesh.edge(random.below(mesh.edge_count()))[0]);
    const auto key = FeaturePairKey::of(vertex, random_piece(pair.b.mesh(), random));
    const DistanceBounds known = rounded_distance(pair, key);
    const double upper = upper_distance(pair, key);
    INFO(upper << " above " << known.upper);
    REQUIRE(upper >= known.lower);
    REQUIRE(upper <= known.upper * (1 + 0x1p-40));
  });
}

TEST_CASE("last witness: a point of a feature is found again where it was, and moves with it") {
  const Shape corner = triangle({0, 0, 0}, {4, 0, 0}, {0, 2, 0});
  Surface a = surface_of(corner);
  const Surface b = surface_of(mapped(corner, 1, {0, 0, 3}));
  DecisionCount count;
  const SurfacePair pair{a, b, count};
  const auto name = FeaturePairKey::of(face_piece(0, Piece::first), vertex_piece(0));
  const LastWitness witness = last_witness_of(pair, name, {1, 0.5, 0}, {0, 0, 3});
  CHECK(std::abs(upper_distance(pair, witness, false) - std::sqrt(1 + 0.25 + 9)) < 1e-5);
  CHECK(upper_distance(pair, {}, false) == infinity);
  REQUIRE(a.set_positions(mapped(corner, 2, {0, 0, 1}).positions).taken());
  CHECK(std::abs(upper_distance(pair, witness, false) - std::sqrt(4 + 1 + 4)) < 1e-5);
}

TEST_CASE("last witness: what an earlier step left does not show in an answer") {
  const FloatingPointScope scope;
  const Shape soup = random_soup(1, 40, 60);
  const Shape sphere = shape_of(models::sphere(16, 12));
  const std::array all{Moves{"spheres", sphere, turned(sphere, 3)},
                       Moves{"soups", soup, random_soup(4, 40, 60)},
                       Moves{"sphere and soup", sphere, mapped(random_soup(7, 30, 40), 0.5, {0, 0, 0})}};
  std::size_t witnesses = 0;
  for (const Moves& moves : all)
    for (const ContactDetail detail : all_details) {
      Surface a = surface_of(moves.a);
      Surface b = surface_of(moves.b);
      LeafFront front;
      PairDetector detector;
      for (std::uint64_t step = 0; step < 24; ++step) {
        Random random(step);
        // Small steps, jumps, through each other and away, both in one place at times.
        const double away = step % 6 == 5 ? random.between(-40, 40) : random.between(0, 2.2);
        REQUIRE(a.set_positions(wobbled(moves.a, 0.05, step).positions).taken());
        REQUIRE(
            b.set_positions(mapped(wobbled(moves.b, 0.05, step + 50), 1, {away, 0.1, 0}).positions).taken());
        a.refit_faces();
        a.refit_vertices();
        b.refit_faces();
        b.refit_vertices();
        a.make_blocks();
        b.make_blocks();
        PairQuery query = query_of(detail, 0.02);
        query.reach = step % 3 == 0 ? infinity : 0.7;
        query.slack = step % 4 < 2 ? 0.05 : 0;
        INFO(moves.name << ", detail " << static_cast<int>(detail) << ", step " << step);
        witnesses += front.witness.is_known() ? 1U : 0U;
        PairAnswer answer;
        PairCounters counters;
        detector.detect(a, b, query, front, answer, counters);
        check_same(answer, detect(a, b, query));
      }
    }
  CHECK(witnesses > 150);
}

}  // namespace graze::tests
