#include "support/oracle/oracle_way_out.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "support/exact/exact.hpp"

namespace graze::oracle {
namespace {

/// The way in which the library moves b. Its length is a choice of the oracle.
const Eigen::Vector3d way{1, 0.7548776662466927, 0.5698402909980532};
constexpr double length = 0x1p-34;

struct Corners {
  std::uint32_t face;
  std::array<Point, 3> point;
  Eigen::Vector3d low, high;
};

/// The triangles of a shape whose corners are three vertices.
std::vector<Corners> triangles_of(const Shape& shape, const Point& moved_by) {
  std::vector<Corners> triangles;
  for (std::uint32_t face = 0; face < shape.faces.size(); ++face) {
    const auto& corner = shape.faces[face];
    for (std::size_t last = 2; last < corner.size(); ++last) {
      const std::array<std::uint32_t, 3> of{corner[0], corner[last - 1], corner[last]};
      if (of[0] == of[1] || of[1] == of[2] || of[2] == of[0]) continue;
      Corners made{face, {}, shape.positions[of[0]], shape.positions[of[0]]};
      for (std::size_t i = 0; i < 3; ++i) {
        made.point[i] = exact(shape.positions[of[i]]) + moved_by;
        made.low = made.low.cwiseMin(shape.positions[of[i]]);
        made.high = made.high.cwiseMax(shape.positions[of[i]]);
      }
      triangles.push_back(std::move(made));
    }
  }
  return triangles;
}

Point normal_of(const Corners& triangle) {
  return cross(triangle.point[1] - triangle.point[0], triangle.point[2] - triangle.point[0]);
}

/// What is met by one triangle's sides in the other.
struct Met {
  std::vector<Point> points;
  bool is_degenerate = false;

  void add(const Corners& sides, const Corners& other) {
    const Point normal = normal_of(other);
    if (is_zero(normal)) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& p = sides.point[i];
      const Point& q = sides.point[(i + 1) % 3];
      const Rational at_p = dot(normal, p - other.point[0]);
      const Rational at_q = dot(normal, q - other.point[0]);
      if ((at_p > 0 && at_q > 0) || (at_p < 0 && at_q < 0)) continue;
      if (at_p == 0 && at_q == 0) {
        is_degenerate = true;
        continue;
      }
      const Point at = p + Rational(at_p / (at_p - at_q)) * (q - p);
      int least = 1;
      for (std::size_t side = 0; side < 3; ++side) {
        const Point& from = other.point[side];
        least = std::min(least, sgn(dot(normal, cross(other.point[(side + 1) % 3] - from, at - from))));
      }
      if (least < 0) continue;
      if (least == 0 || at_p == 0 || at_q == 0) is_degenerate = true;
      points.push_back(at);
    }
  }
};

using Segments = std::vector<std::array<Eigen::Vector3d, 2>>;

bool add_segments(const Shape& a, const Shape& b, const FacePairs& pairs, const Point& moved_by,
                  Segments& segments) {
  const std::vector<Corners> of_b = triangles_of(b, moved_by);
  for (const Corners& one : triangles_of(a, {0, 0, 0}))
    for (const Corners& other : of_b) {
      constexpr double room = 16 * length;
      if ((one.low.array() > other.high.array() + room).any()) continue;
      if ((other.low.array() > one.high.array() + room).any()) continue;
      if (!pairs.may({FeatureKind::face, one.face}, {FeatureKind::face, other.face})) continue;
      Met met;
      met.add(one, other);
      met.add(other, one);
      if (met.is_degenerate) return false;
      if (met.points.size() < 2) continue;
      const bool is_along = dot(cross(normal_of(one), normal_of(other)), met.points[1] - met.points[0]) >= 0;
      segments.push_back({round(met.points[is_along ? 0 : 1]), round(met.points[is_along ? 1 : 0])});
    }
  return true;
}

}  // namespace

double Contour::extent_along(const Eigen::Vector3d& direction,
                             const std::vector<Eigen::Vector3d>& others) const {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto add = [&](const Eigen::Vector3d& point) {
    low = std::min(low, point.dot(direction));
    high = std::max(high, point.dot(direction));
  };
  for (const Segments* const segments : {&up, &down})
    for (const auto& segment : *segments)
      for (const Eigen::Vector3d& point : segment) add(point);
  for (const Eigen::Vector3d& point : others) add(point);
  return std::max(0.0, high - low);
}

std::optional<Contour> contour(const Shape& a, const Shape& b, const FacePairs& pairs) {
  Contour result;
  const Point by = exact(way * length);
  if (!add_segments(a, b, pairs, by, result.up)) return std::nullopt;
  if (!add_segments(a, b, pairs, Rational(-1) * by, result.down)) return std::nullopt;
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  double length_of_all = 0;
  for (const Segments* const segments : {&result.up, &result.down})
    for (const auto& [p, q] : *segments) {
      weighted += (p + q) / 2 * (q - p).norm();
      length_of_all += (q - p).norm();
    }
  result.length = length_of_all;
  if (length_of_all == 0) return result;
  result.middle = weighted / length_of_all;
  double all = 0;
  for (const Segments* const segments : {&result.up, &result.down})
    for (const auto& [p, q] : *segments) {
      const Eigen::Vector3d part = (p - result.middle).cross(q - result.middle) / 4;
      result.area += part;
      all += part.norm();
    }
  result.spread = all;
  if (all > 0) result.fullness = result.area.norm() / all;
  return result;
}

}  // namespace graze::oracle
