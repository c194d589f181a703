#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <graze/box.hpp>
#include <graze/leaf_front.hpp>
#include <graze/surface.hpp>

namespace graze {

/// At least the distance of two points.
inline double upper_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (b - a).norm() * round_up + lost_to_underflow;
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

/// The certified bound of docs/method.md, section 2, for the regions of two surfaces as they are now: from
/// the boxes, and for vertices the spheres about the middle vertices (eq. 2), of the last refit, less the
/// motion since then.
class RegionBounds {
 public:
  RegionBounds(const Surface& a, const Surface& b, bool about_vertices)
      : a_(a),
        b_(b),
        about_vertices_(about_vertices),
        motion_(about_vertices ? (a.motion_since_vertex_refit() + b.motion_since_vertex_refit()) * round_up
                               : (a.motion_since_face_refit() + b.motion_since_face_refit()) * round_up) {}

  /// At most the distance of the regions' vertices, or of the faces and edges that they own.
  [[nodiscard]] double lower(const RegionPair& pair) const {
    const double boxes = less_motion(lower_distance(box_a(pair), box_b(pair)), motion_);
    if (!about_vertices_) return boxes;
    const Region& region_a = a_.mesh().regions().region(pair.a);
    const Region& region_b = b_.mesh().regions().region(pair.b);
    // A radius grows by twice the motion: that of the middle vertex and that of the others.
    return std::max(boxes, less_motion(lower_distance(a_.middle(region_a), a_.radii()[pair.a],
                                                      b_.middle(region_b), b_.radii()[pair.b]),
                                       2 * motion_));
  }

  /// The longest sides of the regions' boxes at the last refit.
  [[nodiscard]] double size_a(const RegionPair& pair) const { return size(box_a(pair)); }
  [[nodiscard]] double size_b(const RegionPair& pair) const { return size(box_b(pair)); }

 private:
  [[nodiscard]] const Box& box_a(const RegionPair& pair) const {
    return about_vertices_ ? a_.vertex_boxes()[pair.a] : a_.face_boxes()[pair.a];
  }
  [[nodiscard]] const Box& box_b(const RegionPair& pair) const {
    return about_vertices_ ? b_.vertex_boxes()[pair.b] : b_.face_boxes()[pair.b];
  }
  static double size(const Box& box) { return (box.max - box.min).maxCoeff(); }
  static double less_motion(double distance, double motion) {
    return motion == 0 ? distance : std::max(0.0, (distance - motion) * round_down);
  }

  const Surface& a_;
  const Surface& b_;
  bool about_vertices_;
  double motion_;
};

}  // namespace graze
