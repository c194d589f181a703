// Rays, moving spheres, closest points and boxes on one surface, against brute force over all its triangles
// in rational arithmetic. Half of the shapes are on grids, where rays meet edges and vertices and lie in
// planes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/cast/box_overlap.hpp"
#include "core/cast/closest_point.hpp"
#include "core/cast/ray_cast.hpp"
#include "core/cast/sphere_cast.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/exact/exact_distance.hpp"
#include "support/mesh_of.hpp"
#include "support/oracle/oracle_distance.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Point;
using oracle::Random;
using oracle::Rational;

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// A shape in both arithmetics.
struct CastTarget {
  explicit CastTarget(std::uint64_t seed)
      : on_grid(seed % 2 != 0), shape(oracle::random_scene(seed).a), surface(mesh_of(shape)), exact(shape) {
    surface.refit_faces();
  }

  /// A point about the shape, at times a vertex or the middle of two.
  [[nodiscard]] Eigen::Vector3d point(Random& random) const {
    const auto vertex = [&] {
      return shape.positions[exact.used[random.below(static_cast<std::uint32_t>(exact.used.size()))]];
    };
    const Eigen::Vector3d first = vertex();
    if (random.chance(0.2)) return first;
    if (random.chance(0.2)) return (first + vertex()) / 2;
    const Eigen::Vector3d offset = random.vector(-2, 2);
    if (!on_grid) return first + offset;
    return first + Eigen::Vector3d((offset * 4).array().round() / 4);
  }

  bool on_grid;
  oracle::Shape shape;
  Surface surface;
  oracle::ExactShape exact;
};

/// The first parameter of a ray in a triangle, and the corners or sides on which the point lies, as in
/// VoronoiRegion: 0 to 2 for corners, 3 to 5 for sides, 6 for the inside.
struct ExactHit {
  Rational t;
  int part;
};

bool is_on_segment(const Point& point, const Point& from, const Point& to) {
  const Point along = to - from;
  if (oracle::is_zero(along) || !oracle::is_zero(oracle::cross(along, point - from))) return false;
  const Rational reach = oracle::dot(along, point - from);
  return reach >= 0 && reach <= oracle::dot(along, along);
}

/// Of a triangle without area, which is its three sides.
std::optional<ExactHit> hit_of_sides(const Point& origin, const Point& way,
                                     const std::array<Point, 3>& corner) {
  std::vector<Rational> candidates{0};
  for (int side = 0; side < 3; ++side) {
    const Point& from = corner[static_cast<std::size_t>(side)];
    const Point edge = corner[static_cast<std::size_t>((side + 1) % 3)] - from;
    candidates.push_back(oracle::dot(from - origin, way) / oracle::dot(way, way));
    const Point across = oracle::cross(way, edge);
    if (!oracle::is_zero(across))
      candidates.push_back(oracle::dot(oracle::cross(from - origin, edge), across) /
                           oracle::dot(across, across));
  }
  std::sort(candidates.begin(), candidates.end());
  for (const Rational& t : candidates) {
    if (t < 0) continue;
    const Point at = origin + t * way;
    for (int i = 0; i < 3; ++i)
      if (oracle::is_zero(at - corner[static_cast<std::size_t>(i)])) return ExactHit{t, i};
    for (int i = 0; i < 3; ++i)
      if (is_on_segment(at, corner[static_cast<std::size_t>(i)],
                        corner[static_cast<std::size_t>((i + 1) % 3)]))
        return ExactHit{t, 3 + i};
  }
  return std::nullopt;
}

/// The ray is clipped by the triangle's plane and by the planes through its sides.
std::optional<ExactHit> hit_of_triangle(const Point& origin, const Point& way,
                                        const std::array<Point, 3>& corner) {
  const Point normal = oracle::cross(corner[1] - corner[0], corner[2] - corner[0]);
  if (oracle::is_zero(normal)) return hit_of_sides(origin, way, corner);
  Rational first = 0;
  std::optional<Rational> last;
  const Rational height = oracle::dot(normal, corner[0] - origin);
  const Rational slope = oracle::dot(normal, way);
  if (slope == 0 && height != 0) return std::nullopt;
  if (slope != 0) {
    first = height / slope;
    last = first;
    if (first < 0) return std::nullopt;
  }
  std::array<Point, 3> inward;
  for (std::size_t side = 0; side < 3; ++side) {
    inward[side] = oracle::cross(normal, corner[(side + 1) % 3] - corner[side]);
    const Rational depth = oracle::dot(inward[side], origin - corner[side]);
    const Rational gain = oracle::dot(inward[side], way);
    if (gain == 0 && depth < 0) return std::nullopt;
    if (gain > 0) first = std::max(first, Rational(-depth / gain));
    if (gain < 0 && (!last || -depth / gain < *last)) last = -depth / gain;
  }
  if (last && *last < first) return std::nullopt;
  const Point at = origin + first * way;
  std::array<bool, 3> is_on{};
  for (std::size_t side = 0; side < 3; ++side)
    is_on[side] = oracle::dot(inward[side], at - corner[side]) == 0;
  for (int i = 0; i < 3; ++i)
    if (is_on[static_cast<std::size_t>(i)] && is_on[static_cast<std::size_t>((i + 2) % 3)])
      return ExactHit{first, i};
  for (int i = 0; i < 3; ++i)
    if (is_on[static_cast<std::size_t>(i)]) return ExactHit{first, 3 + i};
  return ExactHit{first, 6};
}

/// The feature of a part of a triangle of a face, by the numbers of the shape's edges.
Feature feature_of(const CastTarget& target, std::uint32_t face, std::array<std::uint32_t, 3> vertex,
                   int part) {
  const auto index = static_cast<std::size_t>(part);
  if (part < 3) return {FeatureKind::vertex, vertex[index]};
  if (part == 6) return {FeatureKind::face, face};
  std::array<std::uint32_t, 2> ends{vertex[index - 3], vertex[(index - 2) % 3]};
  if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
  const auto& corners = target.shape.faces[face];
  const auto edges = oracle::edges_of(target.shape);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::array<std::uint32_t, 2> side{corners[i], corners[(i + 1) % corners.size()]};
    if (side[0] > side[1]) std::swap(side[0], side[1]);
    if (side == ends)
      return {FeatureKind::edge,
              static_cast<std::uint32_t>(std::find(edges.begin(), edges.end(), ends) - edges.begin())};
  }
  return {FeatureKind::face, face};  // on the diagonal
}

using Hits = std::map<std::pair<double, Feature>, std::pair<std::uint32_t, int>>;

void add_hit(Hits& hits, double t, const Feature& feature, std::uint32_t face, int second) {
  const auto [place, is_new] = hits.try_emplace({t, feature}, face, second);
  if (!is_new) place->second = std::min(place->second, std::pair(face, second));
}

Hits exact_hits(const CastTarget& target, const Eigen::Vector3d& origin, const Eigen::Vector3d& way,
                double limit) {
  Hits hits;
  for (std::uint32_t face = 0; face < target.shape.faces.size(); ++face) {
    const auto& corners = target.shape.faces[face];
    for (std::size_t last = 2; last < corners.size(); ++last) {
      const std::array<std::uint32_t, 3> vertex{corners[0], corners[last - 1], corners[last]};
      const auto hit = hit_of_triangle(
          oracle::exact(origin), oracle::exact(way),
          {target.exact.points[vertex[0]], target.exact.points[vertex[1]], target.exact.points[vertex[2]]});
      if (!hit) continue;
      const double t = oracle::round(hit->t);
      if (t <= limit)
        add_hit(hits, t, feature_of(target, face, vertex, hit->part), face, static_cast<int>(last) - 2);
    }
  }
  return hits;
}

/// Takes all hits.
class AllHits final : public HitSink {
 public:
  explicit AllHits(double limit) : limit_(limit) {}
  [[nodiscard]] double limit() const override { return limit_; }
  void take(const SurfaceHit& hit) override {
    add_hit(hits, hit.t, hit.feature, hit.triangle.face, hit.triangle.second);
  }
  Hits hits;

 private:
  double limit_;
};

/// The square of the exact distance of the way from one point to another, and a shape.
Rational squared_distance_of_way(const CastTarget& target, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& to) {
  const oracle::ExactShape way(oracle::Shape{{from, to}, {{0, 1, 1}}});
  if (oracle::is_pierced(way, target.exact)) return 0;
  return oracle::smallest_distance_squared(way, target.exact);
}

oracle::Foot foot_on_shape(const CastTarget& target, const Point& point) {
  std::optional<oracle::Foot> nearest;
  for (std::uint32_t face = 0; face < target.shape.faces.size(); ++face) {
    oracle::Foot foot = oracle::foot_on_face(point, target.exact, face);
    const int order = nearest ? cmp(foot.distance_squared, nearest->distance_squared) : -1;
    if (order < 0 || (order == 0 && foot.feature < nearest->feature)) nearest = std::move(foot);
  }
  return *nearest;
}

/// Whether a triangle has a point in a box: it is clipped by the six sides of the box.
bool is_in_box(std::vector<Point> outline, const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  for (int plane = 0; plane < 6; ++plane) {
    const int axis = plane / 2;
    const Rational border = plane % 2 == 0 ? Rational(min[axis]) : Rational(-max[axis]);
    const auto depth = [&](const Point& point) {
      const Rational& along = axis == 0 ? point.x : (axis == 1 ? point.y : point.z);
      return Rational((plane % 2 == 0 ? along : Rational(-along)) - border);
    };
    std::vector<Point> clipped;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Point& from = outline[i];
      const Point& to = outline[(i + 1) % outline.size()];
      const Rational before = depth(from);
      const Rational after = depth(to);
      if (before >= 0) clipped.push_back(from);
      if ((before > 0 && after < 0) || (before < 0 && after > 0))
        clipped.push_back(from + Rational(before / (before - after)) * (to - from));
    }
    outline = std::move(clipped);
  }
  return !outline.empty();
}

bool meets_box_exactly(const CastTarget& target, const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  for (const auto& corners : target.shape.faces)
    for (std::size_t last = 2; last < corners.size(); ++last)
      if (is_in_box({target.exact.points[corners[0]], target.exact.points[corners[last - 1]],
                     target.exact.points[corners[last]]},
                    min, max))
        return true;
  return false;
}

}  // namespace

TEST_CASE("a ray hits the features that brute force finds, with correctly rounded parameters") {
  std::array<std::size_t, 3> hits_of_kind{};
  std::size_t misses = 0;
  for (std::uint64_t seed = 0; seed < repeats(1000); ++seed) {
    const CastTarget target(seed);
    Random random(seed + 1);
    for (int round = 0; round < 10; ++round) {
      const Eigen::Vector3d origin = target.point(random);
      const Eigen::Vector3d aim = target.point(random);
      const Eigen::Vector3d way = aim - origin;
      if (way.isZero(0)) continue;
      const double limit = random.chance(0.3) ? 1 : no_limit;
      AllHits found(limit);
      cast_ray({origin, way, Eigen::Vector3d::Zero(), limit}, target.surface, nullptr, found);
      const Hits expected = exact_hits(target, origin, way, limit);
      CAPTURE(seed, round);
      REQUIRE(found.hits == expected);
      if (expected.empty()) ++misses;
      for (const auto& [key, triangle] : expected) ++hits_of_kind[static_cast<std::size_t>(key.second.kind)];
    }
  }
  REQUIRE(misses > repeats(500));
  for (const std::size_t hits : hits_of_kind) REQUIRE(hits > repeats(500));
}

TEST_CASE("a moving sphere touches exactly what it reaches, and never late") {
  std::size_t touches = 0;
  std::size_t starts_inside = 0;
  const std::uint64_t shapes = repeats(1000);
  for (std::uint64_t seed = 0; seed < shapes; ++seed) {
    const CastTarget target(seed);
    Random random(seed + 2);
    for (int round = 0; round < 3; ++round) {
      const Eigen::Vector3d from = target.point(random);
      const Eigen::Vector3d to = random.chance(0.1) ? from : target.point(random);
      const double radius = target.on_grid ? random.below(5) / 4.0 : random.between(0, 1);
      const auto touch = cast_sphere({from, to, radius}, target.surface, nullptr, 1);
      const Rational squared = Rational(radius) * Rational(radius);
      CAPTURE(seed, round, radius);
      REQUIRE(touch.has_value() == (squared_distance_of_way(target, from, to) <= squared));
      if (!touch) continue;
      ++touches;
      const Point way = oracle::exact(to) - oracle::exact(from);
      const auto distance_at = [&](double share) {
        const Rational t = Rational(touch->t) * Rational(share);
        return foot_on_shape(target, oracle::exact(from) + t * way).distance_squared;
      };
      if (touch->t == 0) {
        ++starts_inside;
        REQUIRE(distance_at(1) <= squared);
        continue;
      }
      for (const double share : {0.0, 0.5, 0.99}) REQUIRE(distance_at(share) > squared);
      REQUIRE(distance_at(1) >= squared);
      const double size = 8 + std::max(radius, (to - from).norm());
      const Rational reach = Rational(radius) + Rational(size * 0x1p-40);
      REQUIRE(distance_at(1) <= reach * reach);
    }
  }
  REQUIRE(touches > shapes);
  REQUIRE(starts_inside > shapes / 10);
  REQUIRE(touches - starts_inside > shapes / 4);
}

TEST_CASE("the closest point of a surface is that of brute force") {
  ClosestPointSearch search;
  for (std::uint64_t seed = 0; seed < repeats(1000); ++seed) {
    const CastTarget target(seed);
    Random random(seed + 3);
    for (int round = 0; round < 5; ++round) {
      const Eigen::Vector3d point = target.point(random);
      const double limit = random.chance(0.5) ? no_limit : random.below(4) / 2.0;
      const auto found = search.find(point, target.surface, nullptr, limit);
      const oracle::Foot foot = foot_on_shape(target, oracle::exact(point));
      CAPTURE(seed, round);
      const bool is_near = limit == no_limit || foot.distance_squared < Rational(limit) * Rational(limit);
      REQUIRE(found.has_value() == is_near);
      if (!found) continue;
      REQUIRE(found->feature_b == foot.feature);
      REQUIRE(std::abs(found->distance - oracle::round_sqrt(foot.distance_squared)) <= 1e-13);
      REQUIRE((found->point_b - oracle::round(foot.point)).norm() <= 1e-12);
    }
  }
}

TEST_CASE("a box meets a surface where brute force finds a common point") {
  std::array<std::size_t, 2> answers{};
  for (std::uint64_t seed = 0; seed < repeats(1000); ++seed) {
    const CastTarget target(seed);
    Random random(seed + 4);
    for (int round = 0; round < 10; ++round) {
      const Eigen::Vector3d centre = target.point(random);
      Eigen::Vector3d reach = random.vector(0, 1);
      if (target.on_grid) reach = (reach * 4).array().round() / 4;
      const Eigen::Vector3d min = centre - reach;
      const Eigen::Vector3d max = centre + reach;
      CAPTURE(seed, round);
      const bool expected = meets_box_exactly(target, min, max);
      REQUIRE(meets_box({min, max}, target.surface, nullptr) == expected);
      ++answers[expected ? 1 : 0];
    }
  }
  REQUIRE(std::min(answers[0], answers[1]) > repeats(500));
}

}  // namespace graze::tests
