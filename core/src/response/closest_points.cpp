#include "response/closest_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>

namespace graze {
namespace {

/// The nearest of several pairs of points.
class Nearest {
 public:
  void offer(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d gap = b - a;
    const double squared = gap.squaredNorm();
    if (!(squared < squared_)) return;
    squared_ = squared;
    points_ = {a, b, gap, false};
  }
  [[nodiscard]] const ClosestPoints& points() const { return points_; }

 private:
  double squared_ = std::numeric_limits<double>::infinity();
  ClosestPoints points_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), false};
};

/// Finds the middle of where parallel segments lie beside each other.
std::optional<ClosestPoints> closest_of_parallels(const Segment& a, const Segment& b) {
  const Eigen::Vector3d along = a[1] - a[0];
  const double length = along.squaredNorm();
  const auto [first, last] = std::minmax({along.dot(b[0] - a[0]), along.dot(b[1] - a[0])});
  const double begin = std::max(first, 0.0);
  const double end = std::min(last, length);
  if (!(begin < end)) return std::nullopt;
  const Eigen::Vector3d point = a[0] + along * ((begin + end) / 2 / length);
  const SegmentPoint other = closest_on_segment(point, b);
  if (!other.is_interior) return std::nullopt;
  return ClosestPoints{point, other.point, other.point - point, true};
}

}  // namespace

TrianglePoint closest_on_sides(const Eigen::Vector3d& point, const TrianglePoints& triangle) {
  constexpr std::array parts{TrianglePart::edge_01, TrianglePart::edge_12, TrianglePart::edge_20};
  TrianglePoint best{Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()),
                     TrianglePart::corner};
  for (std::size_t i = 0; i < 3; ++i) {
    const SegmentPoint found = closest_on_segment(point, {triangle[i], triangle[(i + 1) % 3]});
    const Eigen::Vector3d gap = point - found.point;
    if (gap.squaredNorm() < best.gap.squaredNorm())
      best = {gap, found.is_interior ? parts[i] : TrianglePart::corner};
  }
  return best;
}

ClosestPoints closest_of_ends(const Segment& a, const Segment& b, bool are_parallel) {
  if (are_parallel)
    if (const auto beside = closest_of_parallels(a, b)) return *beside;
  Nearest nearest;  // one of the closest points is an end of its edge
  for (const Eigen::Vector3d& end : a) nearest.offer(end, closest_on_segment(end, b).point);
  for (const Eigen::Vector3d& end : b) nearest.offer(closest_on_segment(end, a).point, end);
  return nearest.points();
}

ClosestPoints closest_of_segment_and_triangle(const Segment& segment, const TrianglePoints& triangle) {
  Nearest nearest;
  for (const Eigen::Vector3d& end : segment) nearest.offer(end, end - closest_on_triangle(end, triangle).gap);
  for (std::size_t i = 0; i < 3; ++i) {
    const ClosestPoints found = closest_of_segments(segment, {triangle[i], triangle[(i + 1) % 3]});
    nearest.offer(found.a, found.b);
  }
  return nearest.points();
}

}  // namespace graze
