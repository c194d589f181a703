// Ways out of pairs: against a contour by brute force in exact arithmetic, against the gradient of the volume
// that convex shapes share, and for shapes whose answer is known.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "support/exact/exact_winding.hpp"
#include "support/oracle/oracle_way_out.hpp"
#include "support/random/random_scenes.hpp"
#include "support/random/random_solids.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;
using oracle::Solids;

constexpr double least_fullness = 0.1;

PairQuery way_out_query(ContactDetail detail, Solids solids) {
  PairQuery query = query_of(detail, 0);
  query.a_is_solid = solids.a;
  query.b_is_solid = solids.b;
  query.wants_way_out = true;
  return query;
}

PairAnswer answer_of(const Shape& a, const Shape& b, Solids solids = {true, true},
                     ContactDetail detail = ContactDetail::nearest) {
  return detect(surface_of({a}), surface_of({b}), way_out_query(detail, solids));
}

WayOut way_out_of(const Shape& a, const Shape& b, Solids solids = {true, true}) {
  return answer_of(a, b, solids).way_out;
}

bool is_nothing(const WayOut& way) {
  return way.direction == Vector3d::Zero() && way.point == Vector3d::Zero() && way.fullness == 0 &&
         way.thickness == 0 && way.extent == 0;
}

Shape posed(Shape shape, const Eigen::Isometry3d& pose) {
  for (Vector3d& position : shape.positions) position = pose * position;
  return shape;
}

Shape moved(const Shape& shape, const Vector3d& by) {
  return mapped(shape, 1, by);
}

/// A box about the origin.
Shape centred_box(const Vector3d& half) {
  return box(-half, 2 * half);
}

/// Two triangles for each quad.
Shape split(Shape shape) {
  std::vector<std::vector<std::uint32_t>> triangles;
  for (const auto& face : shape.faces)
    for (std::size_t last = 2; last < face.size(); ++last)
      triangles.push_back({face[0], face[last - 1], face[last]});
  shape.faces = std::move(triangles);
  return shape;
}

Eigen::Isometry3d random_pose(Random& random, double reach) {
  const Vector3d axis = random.vector(-1, 1);
  const double angle = random.between(0, 6);
  const Vector3d at = random.vector(-reach, reach);
  return Eigen::Translation3d(at) * Eigen::AngleAxisd(angle, axis.normalized());
}

// ---- Against brute force

std::vector<Vector3d> vertices_inside(const Shape& shape, const Shape& solid) {
  std::vector<Vector3d> inside;
  const oracle::WindingOracle winding(solid);
  std::vector<bool> is_used(shape.positions.size());
  for (const auto& face : shape.faces)
    for (const std::uint32_t corner : face) is_used[corner] = true;
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (is_used[i] && winding.about(shape.positions[i]).is_inside()) inside.push_back(shape.positions[i]);
  return inside;
}

double highest_of(const Shape& shape, const Vector3d& direction) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const auto& face : shape.faces)
    for (const std::uint32_t corner : face)
      highest = std::max(highest, shape.positions[corner].dot(direction));
  return highest;
}

/// How a way out differs from brute force. Empty if it does not.
std::string difference_of(const WayOut& way, const Shape& a, const Shape& b, Solids solids, bool crosses,
                          const oracle::Contour& truth) {
  constexpr double tolerance = 1e-6;
  if (!crosses || truth.is_empty()) return is_nothing(way) ? "" : "a way out where nothing crosses\n";
  if (truth.length < 1e-3 || truth.spread < 1e-5 * truth.length) return "";  // as good as a line, or a point
  std::string text;
  if (std::abs(way.fullness - truth.fullness) > tolerance) text += "fullness\n";
  if ((way.point - truth.middle).norm() > tolerance) text += "point\n";
  if (std::abs(truth.fullness - least_fullness) < tolerance) return text;
  if (truth.fullness < least_fullness) {
    if (way.direction != Vector3d::Zero() || way.thickness != 0 || way.extent != 0) text += "not zero\n";
    return text;
  }
  if ((way.direction - truth.area.normalized()).norm() > tolerance) text += "direction\n";
  std::vector<Vector3d> inside;
  if (solids.b) inside = vertices_inside(a, b);
  if (solids.a)
    for (const Vector3d& vertex : vertices_inside(b, a)) inside.push_back(vertex);
  if (std::abs(way.thickness - truth.extent_along(way.direction, inside)) > tolerance) text += "thickness\n";
  const double extent = highest_of(a, way.direction) + highest_of(b, -way.direction);
  if (!(way.extent >= extent && way.extent <= extent * (1 + 1e-13) + 1e-12)) text += "extent\n";
  return text;
}

struct Met {
  std::size_t compared = 0;
  std::size_t with_direction = 0;
  std::size_t cancelled = 0;
};

void compare_with_brute_force(const Shape& a, const Shape& b, Solids solids, Met& met) {
  const std::optional<oracle::Contour> truth = oracle::contour(a, b);
  if (!truth) return;
  const bool has_solid = solids.a || solids.b;
  const oracle::Containment inside =
      has_solid ? oracle::solid_pair(a, b, solids, 0).inside : oracle::Containment::none;
  const bool crosses = inside == oracle::Containment::crossing || oracle::surface_distance(a, b).pierced ||
                       (inside == oracle::Containment::none && !truth->up.empty() && !truth->down.empty());
  for (const ContactDetail detail : surface_details) {
    INFO("detail " << static_cast<int>(detail));
    const WayOut way = answer_of(a, b, solids, detail).way_out;
    INFO("length " << truth->length << ", fullness " << way.fullness << " and " << truth->fullness);
    REQUIRE(difference_of(way, a, b, solids, crosses, *truth) == "");
    ++met.compared;
    if (way.direction != Vector3d::Zero()) ++met.with_direction;
    if (crosses && !truth->is_empty() && way.direction == Vector3d::Zero()) ++met.cancelled;
  }
}

TEST_CASE("Ways out of solids are those of brute force", "[way_out]") {
  const FloatingPointScope scope;
  Met met;
  for (std::uint64_t seed = 0; seed < 160; ++seed) {
    const oracle::RandomSolids scene = oracle::random_solids(seed);
    INFO("seed " << seed);
    compare_with_brute_force(scene.a, scene.b, scene.solids, met);
  }
  CHECK(met.compared > 500);
  CHECK(met.with_direction > 150);
  CHECK(met.cancelled > 4);
}

TEST_CASE("Ways out of open surfaces are those of brute force", "[way_out]") {
  const FloatingPointScope scope;
  Met met;
  for (std::uint64_t seed = 0; seed < repeats(120); ++seed) {
    INFO("seed " << seed);
    const Shape a = random_soup(2 * seed, 9, 12);
    compare_with_brute_force(a, random_soup(2 * seed + 1000, 9, 12), {false, false}, met);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    compare_with_brute_force(scene.a, scene.b, {false, false}, met);
  }
  CHECK(met.compared > repeats(500));
  CHECK(met.with_direction > repeats(60));
  CHECK(met.cancelled > repeats(20));
}

// ---- Against the volume that convex shapes share

using Polygon = std::vector<Vector3d>;

/// The part of a polygon behind a plane.
Polygon clipped(const Polygon& polygon, const Vector3d& normal, double offset) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& p = polygon[i];
    const Vector3d& q = polygon[(i + 1) % polygon.size()];
    const double at_p = normal.dot(p) - offset;
    const double at_q = normal.dot(q) - offset;
    if (at_p <= 0) result.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      result.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return result;
}

/// Thrice the volume between the origin and the faces of `of` inside `by`. Both are convex, of triangles.
double volume_below(const Shape& of, const Shape& by) {
  double sum = 0;
  for (const auto& face : of.faces) {
    Polygon polygon;
    for (const std::uint32_t corner : face) polygon.push_back(of.positions[corner]);
    for (const auto& plane : by.faces) {
      const Vector3d& at = by.positions[plane[0]];
      const Vector3d normal = (by.positions[plane[1]] - at).cross(by.positions[plane[2]] - at);
      polygon = clipped(polygon, normal, normal.dot(at));
    }
    for (std::size_t i = 2; i < polygon.size(); ++i)
      sum += polygon[0].dot(polygon[i - 1].cross(polygon[i])) / 2;
  }
  return sum;
}

double shared_volume(const Shape& a, const Shape& b) {
  return (volume_below(a, b) + volume_below(b, a)) / 3;
}

/// The gradient by a translation of b.
Vector3d gradient_of_volume(const Shape& a, const Shape& b) {
  constexpr double step = 1e-4;
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis)
    gradient[axis] = (shared_volume(a, moved(b, Vector3d::Unit(axis) * step)) -
                      shared_volume(a, moved(b, -Vector3d::Unit(axis) * step))) /
                     (2 * step);
  return gradient;
}

/// A box, a tetrahedron or an octahedron, stretched and turned.
Shape random_convex(Random& random) {
  Shape shape = split(centred_box({1, 1, 1}));
  const std::uint32_t kind = random.below(3);
  if (kind == 1)
    shape = {{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
             {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}}};
  if (kind == 2)
    shape = {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
             {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  const Vector3d stretch = random.vector(0.3, 1);
  for (Vector3d& position : shape.positions) position = position.cwiseProduct(stretch);
  return posed(shape, random_pose(random, 0));
}

TEST_CASE("The direction is against the gradient of the volume that two convex solids share", "[way_out]") {
  const FloatingPointScope scope;
  Random random(5);
  std::size_t crossing = 0;
  for (int i = 0; i < 600; ++i) {
    const Shape a = random_convex(random);
    const Vector3d by = random.vector(-1.2, 1.2);
    const Shape b = moved(random_convex(random), by);
    const PairAnswer answer = answer_of(a, b);
    const WayOut& way = answer.way_out;
    if (answer.inside != Inside::crossing) {
      REQUIRE(is_nothing(way));
      continue;
    }
    const Vector3d gradient = gradient_of_volume(a, b);
    if (way.direction == Vector3d::Zero() || gradient.norm() < 1e-3) continue;
    ++crossing;
    INFO("pair " << i << ", fullness " << way.fullness);
    REQUIRE((way.direction + gradient.normalized()).norm() < 1e-3);
    const PairAnswer left = answer_of(a, moved(b, way.direction * (way.extent + 1e-12)));
    REQUIRE(left.inside == Inside::none);
    REQUIRE(shared_volume(a, moved(b, way.direction * way.extent)) < 1e-12);
    REQUIRE(way.thickness <= way.extent + 1e-9);
  }
  CHECK(crossing > 200);
}

TEST_CASE("A way out turns round with the objects, and moves with them", "[way_out]") {
  const FloatingPointScope scope;
  Random random(6);
  std::size_t crossing = 0;
  for (int i = 0; i < 200; ++i) {
    const Shape a = random_convex(random);
    const Vector3d by = random.vector(-0.8, 0.8);
    const Shape b = moved(random_convex(random), by);
    const WayOut way = way_out_of(a, b);
    if (way.direction == Vector3d::Zero()) continue;
    ++crossing;
    const auto is_close = [&](const WayOut& other, double sign, const Vector3d& offset, double tolerance) {
      CHECK((other.direction * sign - way.direction).norm() < tolerance);
      CHECK((other.point - offset - way.point).norm() < tolerance);
      CHECK(std::abs(other.fullness - way.fullness) < tolerance);
      CHECK(std::abs(other.thickness - way.thickness) < tolerance);
      CHECK(std::abs(other.extent - way.extent) < tolerance);
    };
    is_close(way_out_of(b, a), -1, Vector3d::Zero(), 1e-9);
    const Vector3d far{100, -300, 50};
    is_close(way_out_of(moved(a, far), moved(b, far)), 1, far, 1e-7);
  }
  CHECK(crossing > 80);
}

// ---- Known answers

TEST_CASE("A plank that has sunk into a plank leaves it upwards", "[way_out]") {
  const FloatingPointScope scope;
  const Shape plank = centred_box({0.6, 0.12, 0.05});
  for (const bool is_split : {false, true}) {
    const Shape a = is_split ? split(plank) : plank;
    const Shape b = posed(a, Eigen::Translation3d(0, 0, 0.09) * Eigen::AngleAxisd(1.5, Vector3d::UnitZ()));
    const WayOut way = way_out_of(a, b);
    CHECK((way.direction - Vector3d::UnitZ()).norm() < 1e-9);
    CHECK(std::abs(way.thickness - 0.01) < 1e-9);
    CHECK(std::abs(way.extent - 0.01) < 1e-9);
    CHECK(way.extent >= 0.01 - 1e-17);
    CHECK((way.point - Vector3d(0, 0, 0.045)).norm() < 1e-9);
    CHECK(way.fullness > 0.5);
    CHECK(way.fullness <= 1);
  }
}

TEST_CASE("A stake straight through a plank has a contour but no way out", "[way_out]") {
  const FloatingPointScope scope;
  const Shape stake = box({0.03, 0.01, -0.4}, {0.04, 0.04, 1});
  const WayOut way = way_out_of(centred_box({0.6, 0.12, 0.05}), stake);
  CHECK(way.fullness < 1e-9);
  CHECK(way.direction == Vector3d::Zero());
  CHECK(way.thickness == 0);
  CHECK(way.extent == 0);
  CHECK((way.point - Vector3d(0.05, 0.03, 0)).norm() < 1e-9);
}

TEST_CASE("What lies inside, beside or on another object has no way out", "[way_out]") {
  const FloatingPointScope scope;
  const Shape cube = box({0, 0, 0}, {1, 1, 1});
  CHECK(is_nothing(way_out_of(cube, box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}))));
  CHECK(is_nothing(way_out_of(cube, box({2, 0, 0}, {1, 1, 1}))));
  for (const Solids solids : {Solids{true, true}, Solids{false, false}}) {
    CHECK(is_nothing(way_out_of(cube, box({0, 0, 1}, {1, 1, 1}), solids)));
    CHECK(is_nothing(way_out_of(cube, box({0.25, 0.25, 1}, {0.5, 2, 1}), solids)));
  }
}

TEST_CASE("The last bits of a pose do not turn the way out of boxes that share planes", "[way_out]") {
  const FloatingPointScope scope;
  const Shape cube = box({0, 0, 0}, {1, 1, 1});
  struct Flush {
    const char* name;
    Shape b;
    Vector3d area;  ///< by hand
  };
  constexpr double depth = 0.25;
  // The sides that are shared count half where b covers them alone from one side, and cancel where both do.
  const std::array<Flush, 4> all{{
      {"four planes", box({0, 0, 1 - depth}, {1, 1, 1}), {0, 0, 1}},
      {"two planes, opposite", box({0, 0.25, 1 - depth}, {1, 0.5, 1}), {0, 0, 0.5}},
      {"one plane", box({0, 0.25, 1 - depth}, {1.5, 0.5, 1}), {0.5 * 0.5 * depth, 0, 0.5}},
      {"a corner", box({0, 0, 1 - depth}, {1.5, 1.5, 1}), {0.5 * depth, 0.5 * depth, 1}},
  }};
  Random random(7);
  for (const Flush& flush : all) {
    INFO(flush.name);
    const WayOut way = way_out_of(cube, flush.b);
    CHECK((way.direction - flush.area.normalized()).norm() < 1e-9);
    for (int i = 0; i < 200; ++i) {
      const double size = std::pow(10, random.between(-16, -12));
      const Vector3d axis = random.vector(-1, 1);
      const Vector3d by = random.vector(-size, size);
      const Eigen::Isometry3d pose(Eigen::Translation3d(by) * Eigen::AngleAxisd(size, axis.normalized()));
      const WayOut turned = way_out_of(cube, posed(flush.b, pose));
      INFO("a pose that is " << size << " off");
      REQUIRE((turned.direction - way.direction).norm() < 1e-9);
      REQUIRE((turned.point - way.point).norm() < 1e-9);
      REQUIRE(std::abs(turned.fullness - way.fullness) < 1e-9);
      REQUIRE(std::abs(turned.thickness - way.thickness) < 1e-9);
      REQUIRE(std::abs(turned.extent - way.extent) < 1e-9);
    }
  }
}

TEST_CASE("A tent through a sheet leaves it along the sheet's normal", "[way_out]") {
  const FloatingPointScope scope;
  const Shape tent{{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {0, 0, 0.5}},
                   {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  const Shape sheet = quad({-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
  const WayOut way = way_out_of(sheet, tent, {false, false});
  CHECK((way.direction - Vector3d::UnitZ()).norm() < 1e-9);
  CHECK(std::abs(way.fullness - 1) < 1e-9);
  CHECK(way.point.norm() < 1e-9);
  CHECK(way.thickness < 1e-9);
  CHECK(std::abs(way.extent - 1) < 1e-9);
  const WayOut swapped = way_out_of(tent, sheet, {false, false});
  CHECK((swapped.direction + Vector3d::UnitZ()).norm() < 1e-9);
}

TEST_CASE("A contour that ends at borders has the area to its middle", "[way_out]") {
  const FloatingPointScope scope;
  // A sheet with a ridge along y, cut by one that stands upright: the contour is the ridge's outline.
  const Shape ridge{{{-1, -1, 0}, {0, -1, 1}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 1}, {1, 1, 0}},
                    {{0, 1, 4, 3}, {1, 2, 5, 4}}};
  const Shape upright = quad({-2, 0.25, -1}, {2, 0.25, -1}, {2, 0.25, 2}, {-2, 0.25, 2});
  const WayOut way = way_out_of(ridge, upright, {false, false});
  CHECK((way.point - Vector3d(0, 0.25, 0.5)).norm() < 1e-9);
  CHECK(std::abs(way.fullness - 1) < 1e-9);
  CHECK((way.direction.cwiseAbs() - Vector3d::UnitY()).norm() < 1e-9);
  // Two flat sheets cross in a line, which has no area.
  const WayOut line =
      way_out_of(quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}), upright, {false, false});
  CHECK(line.fullness == 0);
  CHECK(line.direction == Vector3d::Zero());
  CHECK((line.point - Vector3d(0, 0.25, 0)).norm() < 1e-9);
}

// ---- Budgets, and pairs in slices

TEST_CASE("A budget that is spent before the way out leaves an answer that is not complete", "[way_out]") {
  const FloatingPointScope scope;
  const Surface a = surface_of({split(centred_box({1, 1, 1}))});
  const Surface b = surface_of({moved(centred_box({0.5, 0.5, 0.5}), {0.2, 0.1, 1.2})});
  PairQuery query = way_out_query(ContactDetail::nearest, {true, true});
  PairCounters counters;
  PairAnswer whole;
  PairDetector().detect(a, b, query, whole, counters);
  REQUIRE(whole.complete);
  REQUIRE(whole.way_out.fullness > 0);
  std::size_t complete = 0;
  for (query.work_limit = 0; query.work_limit <= counters.region_pairs_tested; ++query.work_limit) {
    PairCounters own;
    PairAnswer answer;
    PairDetector().detect(a, b, query, answer, own);
    if (answer.complete) {
      ++complete;
      CHECK(answer.way_out.direction == whole.way_out.direction);
    } else {
      CHECK(is_nothing(answer.way_out));
    }
  }
  CHECK(complete == 1);
}

}  // namespace
}  // namespace graze::tests
