#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "experiment/regions/bounding_volumes.hpp"

namespace graze::tools {

/// Three directions at right angles to each other (but for at most 2^-46), along which a region's points
/// spread most first, and the points in them, from their mean.
struct PrincipalFrame {
  explicit PrincipalFrame(std::span<const Eigen::Vector3d> points);

  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 3> axes;
  std::vector<Eigen::Vector3d> local;
};

/// The distance that each point of a region may still have along the axes that are not fitted yet. Together
/// with the distance already spent it must stay within one radius for all points.
class RadiusLeft {
 public:
  explicit RadiusLeft(std::size_t point_count) : squared_(point_count, 0) {}

  /// Before the radius is fixed: the middle of the points' extent along an axis of no length.
  double spend_about_middle(std::span<const Eigen::Vector3d> local, Eigen::Index axis);
  /// The radius that what was spent takes.
  double fix_radius();

  struct Side {
    double middle, half;
  };
  /// The shortest side along an axis that leaves no point further beyond its ends than it may be.
  Side spend_beyond_side(std::span<const Eigen::Vector3d> local, Eigen::Index axis);

 private:
  std::vector<double> squared_;  ///< of the distance spent, then of what is left
};

/// Everything within `radius` of a segment (1 axis: the line swept sphere), of a rectangle (2: the rectangle
/// swept sphere) or of an oriented box (3; its radius is rounding alone).
template <std::size_t axis_count>
struct SweptBox {
  static constexpr const char* name = axis_count == 1   ? "line swept sphere"
                                      : axis_count == 2 ? "rectangle swept sphere"
                                                        : "oriented box";
  static constexpr bool merges = false;

  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, axis_count> axes;
  std::array<double, axis_count> half;  ///< of the lengths along the axes
  double radius = 0;  ///< a little larger than needed: by what rounding loses here and in `lower_distance`

  /// The radius is that of the region's points about the line or plane through the middle of their extent;
  /// then each side in turn is as short as that radius leaves it.
  static SweptBox around(const RegionPoints& region);

  /// The inner points of a segment, rectangle or box that are nearest to `point`, from its centre.
  [[nodiscard]] Eigen::Vector3d nearest(const Eigen::Vector3d& point) const {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < axis_count; ++i)
      result += std::clamp(axes[i].dot(point), -half[i], half[i]) * axes[i];
    return result;
  }
  /// How far the inner part reaches from its centre along `direction`, times that one's length.
  [[nodiscard]] double reach(const Eigen::Vector3d& direction) const {
    double result = 0;
    for (std::size_t i = 0; i < axis_count; ++i) result += std::abs(axes[i].dot(direction)) * half[i];
    return result;
  }

  /// The gap between them along one direction. Any direction's is a lower bound; the best one runs between
  /// the nearest points, to which going from one's nearest to the other's in turns leads.
  friend double lower_distance(const SweptBox& a, const SweptBox& b) {
    constexpr int turns = 3;
    const Eigen::Vector3d between = b.centre - a.centre;
    Eigen::Vector3d in_b = between;
    Eigen::Vector3d direction = between;
    for (int turn = 0; turn < turns; ++turn) {
      const Eigen::Vector3d in_a = a.nearest(in_b);
      in_b = between + b.nearest(in_a - between);
      direction = in_b - in_a;
    }
    const double length = direction.norm();
    const double apart = between.norm();
    if (!(length > apart * 0x1p-40) || length < 0x1p-400) return 0;  // they overlap, or may
    const double gap = (direction.dot(between) - a.reach(direction) - b.reach(direction)) / length;
    return std::max(0.0, gap - a.radius - b.radius - apart * 0x1p-44);
  }
};

template <std::size_t axis_count>
SweptBox<axis_count> SweptBox<axis_count>::around(const RegionPoints& region) {
  const PrincipalFrame frame(region.points);
  SweptBox result;
  result.centre = frame.mean;
  RadiusLeft left(frame.local.size());
  double size = 0;
  for (std::size_t i = axis_count; i < 3; ++i) {
    const double middle = left.spend_about_middle(frame.local, static_cast<Eigen::Index>(i));
    result.centre += middle * frame.axes[i];
    size += std::abs(middle);
  }
  const double radius = left.fix_radius();
  for (std::size_t i = 0; i < axis_count; ++i) {
    const auto [middle, half] = left.spend_beyond_side(frame.local, static_cast<Eigen::Index>(i));
    result.centre += middle * frame.axes[i];
    result.axes[i] = frame.axes[i];
    result.half[i] = half;
    size += std::abs(middle) + half;
  }
  const double lost_to_place = result.centre.cwiseAbs().maxCoeff() * 0x1p-50;
  result.radius = radius + (size + radius) * 0x1p-42 + lost_to_place + lost_to_underflow;
  return result;
}

}  // namespace graze::tools
