#include "cast/sphere_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "response/closest_points.hpp"

namespace graze {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

/// The squares of a distance and of the radius, times one positive number.
template <typename Number>
int compare_with_radius(const Number& square, const Number& times, double radius, bool& unsure) {
  return sign(square - Number(radius) * Number(radius) * times, unsure);
}

/// Whether a sphere's path comes within the radius of a triangle, by its closest points. It does if the
/// closest points of some pair of their features are that near. Each pair is asked on its own.
class PathAndTriangle {
 public:
  PathAndTriangle(const SphereSweep& sweep, const Corners& corner, DecisionCount& count)
      : ends_{sweep.from, sweep.to}, corner_(corner), radius_(sweep.radius), count_(count) {}

  [[nodiscard]] bool are_within() const {
    for (const Eigen::Vector3d& end : ends_)
      if (is_end_within(end)) return true;
    for (std::size_t side = 0; side < 3; ++side)
      if (is_near_segment(corner_[side], ends_[0], ends_[1]) || crosses_side(side)) return true;
    return pierces();
  }

 private:
  [[nodiscard]] bool is_end_within(const Eigen::Vector3d& end) const {
    for (std::size_t side = 0; side < 3; ++side)
      if (is_near_point(end, corner_[side]) || is_near_segment(end, corner_[side], corner_[(side + 1) % 3]))
        return true;
    return is_near_face(end);
  }
  [[nodiscard]] bool is_near_point(const Eigen::Vector3d& point, const Eigen::Vector3d& other) const {
    return decide(count_, [&]<typename Number>(bool& unsure) {
             const Vector<Number> between = difference<Number>(point, other);
             return compare_with_radius(dot(between, between), Number(1.0), radius_, unsure);
           }) <= 0;
  }
  /// Whether a point is near the line of a segment, and beside its inside.
  [[nodiscard]] bool is_near_segment(const Eigen::Vector3d& point, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& to) const {
    return decide(count_, [&]<typename Number>(bool& unsure) {
      const Vector<Number> along = difference<Number>(to, from);
      const Vector<Number> way = difference<Number>(point, from);
      const Number reach = dot(along, way);
      const Number length = dot(along, along);
      const Vector<Number> across = cross(along, way);
      return sign(reach, unsure) > 0 && sign(length - reach, unsure) > 0 &&
             compare_with_radius(dot(across, across), length, radius_, unsure) <= 0;
    });
  }
  /// Whether a point is near the plane of the triangle, and over its inside.
  [[nodiscard]] bool is_near_face(const Eigen::Vector3d& point) const {
    return decide(count_, [&]<typename Number>(bool& unsure) {
      const Vector<Number> normal = normal_of_corners<Number>(corner_);
      const Number height = dot(normal, difference<Number>(point, corner_[0]));
      if (compare_with_radius(height * height, dot(normal, normal), radius_, unsure) > 0) return false;
      for (std::size_t side = 0; side < 3; ++side) {
        const Vector<Number> edge = difference<Number>(corner_[(side + 1) % 3], corner_[side]);
        if (sign(dot(normal, cross(edge, difference<Number>(point, corner_[side]))), unsure) <= 0)
          return false;
      }
      return true;
    });
  }
  /// Whether the lines of the path and of a side are near each other at points inside both.
  [[nodiscard]] bool crosses_side(std::size_t side) const {
    return decide(count_, [&]<typename Number>(bool& unsure) {
      const Vector<Number> path = difference<Number>(ends_[1], ends_[0]);
      const Vector<Number> edge = difference<Number>(corner_[(side + 1) % 3], corner_[side]);
      const Vector<Number> between = difference<Number>(corner_[side], ends_[0]);
      const Vector<Number> across = cross(path, edge);
      const Number length = dot(across, across);
      const Number of_path = dot(cross(between, edge), across);
      const Number of_edge = dot(cross(between, path), across);
      const Number volume = dot(across, between);
      return sign(of_path, unsure) > 0 && sign(length - of_path, unsure) > 0 && sign(of_edge, unsure) > 0 &&
             sign(length - of_edge, unsure) > 0 &&
             compare_with_radius(volume * volume, length, radius_, unsure) <= 0;
    });
  }
  /// Whether the path passes through the inside of the triangle.
  [[nodiscard]] bool pierces() const {
    return decide(count_, [&]<typename Number>(bool& unsure) {
      const Vector<Number> normal = normal_of_corners<Number>(corner_);
      const int first = sign(dot(normal, difference<Number>(ends_[0], corner_[0])), unsure);
      const int second = sign(dot(normal, difference<Number>(ends_[1], corner_[0])), unsure);
      if (first == second) return false;
      for (std::size_t side = 0; side < 3; ++side) {
        const int turn = sign(dot(difference<Number>(ends_[1], ends_[0]),
                                  cross(difference<Number>(corner_[side], ends_[0]),
                                        difference<Number>(corner_[(side + 1) % 3], ends_[0]))),
                              unsure);
        if (turn != (first < second ? 1 : -1)) return false;
      }
      return true;
    });
  }

  const std::array<Eigen::Vector3d, 2> ends_;
  const Corners& corner_;
  const double radius_;
  DecisionCount& count_;
};

/// A direction, and until when a plane across it parts a moving sphere from a triangle.
class PartingPlanes {
 public:
  PartingPlanes(const SphereSweep& sweep, const Corners& corner)
      : sweep_(sweep), corner_(corner), way_(sweep.to - sweep.from) {
    for (const Eigen::Vector3d& point : corner)
      size_ = std::max(size_, (point - sweep.from).cwiseAbs().maxCoeff());
  }

  static constexpr double always = std::numeric_limits<double>::infinity();

  /// Until when the sphere is certainly on its side of the planes across `direction`, whose largest component
  /// is 1 or -1. It is `always`, or negative where that cannot be told even of the start. The direction is
  /// taken as it is: no error in it matters.
  [[nodiscard]] double apart_until(const Eigen::Vector3d& direction) const {
    double height = always;
    for (const Eigen::Vector3d& point : corner_)
      height = std::min(height, direction.dot(sweep_.from - point));
    // Each term of a dot product is off by three roundings at most, and the sum by two.
    const double start =
        (height - size_ * off) - sweep_.radius * (direction.norm() * (1 + 0x1p-50)) * (1 + 0x1p-50);
    if (!(start > 0)) return -1;
    const double speed = direction.dot(way_) - way_.cwiseAbs().maxCoeff() * off;
    return speed >= 0 ? always : start / -speed * (1 - 0x1p-50);
  }

 private:
  static constexpr double off = 0x1p-48;

  const SphereSweep& sweep_;
  const Corners& corner_;
  Eigen::Vector3d way_;
  double size_ = 0;
};

}  // namespace

std::optional<double> touch_time(const SphereSweep& sweep, const std::array<Eigen::Vector3d, 3>& corner,
                                 double limit) {
  // Newton's method. The distance is convex in time, so that each tangent bounds it from below: the plane
  // across the gap at one time parts the two until another time, never later than the touch.
  constexpr int most_rounds = 64;
  const PartingPlanes planes(sweep, corner);
  double t = 0;
  for (int round = 0; round < most_rounds; ++round) {
    Eigen::Vector3d gap = closest_on_triangle(sweep.centre(t), corner).gap;
    const double size = gap.cwiseAbs().maxCoeff();
    if (!(size > 0x1p-1000)) break;
    gap /= size;
    const double until = planes.apart_until(gap);
    if (until > limit) return std::nullopt;
    if (!(until > t + 0x1p-52 * t)) break;
    t = until;
  }
  return t;
}

bool ever_touches(const SphereSweep& sweep, const std::array<Eigen::Vector3d, 3>& corner,
                  DecisionCount& count) {
  return PathAndTriangle(sweep, corner, count).are_within();
}

}  // namespace graze
