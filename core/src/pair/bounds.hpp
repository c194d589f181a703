#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/base/box.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// At least the distance of two points.
inline double upper_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (b - a).norm() * round_up + lost_to_underflow;
}

/// Whether two points with this upper distance may be apart. Points at one position are not.
inline bool may_be_apart(double upper_distance) {
  return upper_distance > lost_to_underflow;
}

/// At most the distance of two points.
inline double lower_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::max(0.0, (b - a).norm() - lost_to_underflow) * round_down;
}

/// At most the distance of any vertex within `radius_a` of `middle_a` and any within `radius_b` of
/// `middle_b`, for radii that are rounded themselves.
inline double lower_distance(const Eigen::Vector3d& middle_a, double radius_a,
                             const Eigen::Vector3d& middle_b, double radius_b) {
  const double radii = (radius_a + radius_b) * round_up + 2 * lost_to_underflow;
  return std::max(0.0, (lower_distance(middle_a, middle_b) - radii) * round_down);
}

/// At most the distance of two regions whose boxes are along their faces, where these are not null, or along
/// the axes of space.
double lower_of_long(const OrientedBox* oriented_a, const Box& box_a, const OrientedBox* oriented_b,
                     const Box& box_b);

/// The certified bound of docs/method.md, section 2, for the regions of two surfaces as they are now: from
/// the boxes of the last refit, less the motion since then.
class RegionBounds {
 public:
  RegionBounds(const Surface& a, const Surface& b, RefitOf boxes)
      : a_(a),
        b_(b),
        boxes_(boxes),
        motion_((a.motion_since_refit(boxes) + b.motion_since_refit(boxes)) * round_up),
        has_long_(boxes == RefitOf::faces &&
                  !(a.mesh().long_regions().empty() && b.mesh().long_regions().empty())) {}

  /// At most the distance of the regions' vertices, or of the faces and edges that they own.
  [[nodiscard]] double lower(const RegionPair& pair) const {
    const double lower = lower_distance(box_a(pair), box_b(pair));
    return less_motion(has_long_ ? std::max(lower, lower_of_long_regions(pair)) : lower, motion_);
  }
  /// At least the distance of any point of one region and any of the other, of all that the boxes hold.
  [[nodiscard]] double upper(const RegionPair& pair) const {
    const Eigen::Vector3d way =
        (box_b(pair).max - box_a(pair).min).cwiseMax(box_a(pair).max - box_b(pair).min);
    return (upper_distance(Eigen::Vector3d::Zero(), way) + motion_) * round_up;
  }
  /// A bound for vertices that also uses the spheres about the middle vertices (eq. 2). The spheres leave out
  /// next to nothing that boxes do not. They are worth their refit only where the paper's regions are
  /// reported.
  [[nodiscard]] double lower_with_spheres(const RegionPair& pair) const {
    const Region& region_a = a_.mesh().regions().region(pair.a);
    const Region& region_b = b_.mesh().regions().region(pair.b);
    const double motion =
        (a_.motion_since_refit(RefitOf::radii) + b_.motion_since_refit(RefitOf::radii)) * round_up;
    // A radius grows by twice the motion: that of the middle vertex and that of the others.
    return std::max(lower(pair), less_motion(lower_distance(a_.middle(region_a), a_.radii()[pair.a],
                                                            b_.middle(region_b), b_.radii()[pair.b]),
                                             2 * motion));
  }

  /// The longest sides of the regions' boxes at the last refit.
  [[nodiscard]] double size_a(const RegionPair& pair) const { return size(box_a(pair)); }
  [[nodiscard]] double size_b(const RegionPair& pair) const { return size(box_b(pair)); }

 private:
  [[nodiscard]] const Box& box_a(const RegionPair& pair) const { return a_.boxes(boxes_)[pair.a]; }
  [[nodiscard]] const Box& box_b(const RegionPair& pair) const { return b_.boxes(boxes_)[pair.b]; }
  /// Apart from `lower`, which is so small that it is inlined.
  [[nodiscard]] double lower_of_long_regions(const RegionPair& pair) const;
  static double size(const Box& box) { return (box.max - box.min).maxCoeff(); }
  static double less_motion(double distance, double motion) {
    return motion == 0 ? distance : std::max(0.0, (distance - motion) * round_down);
  }

  const Surface& a_;
  const Surface& b_;
  RefitOf boxes_;
  double motion_;
  bool has_long_;  ///< of either surface
};

}  // namespace graze
