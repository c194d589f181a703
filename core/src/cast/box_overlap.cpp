#include "core/cast/box_overlap.hpp"

#include <array>

#include "arithmetic/arithmetic.hpp"
#include "cast/triangles.hpp"
#include "surface/region_visit.hpp"

namespace graze {
namespace {

/// Asks whether an axis parts a box from a triangle (separating axis theorem). Both are closed. Decided
/// exactly.
class BoxAndTriangle {
 public:
  BoxAndTriangle(const Box& box, const std::array<Eigen::Vector3d, 3>& corner, DecisionCount& count)
      : box_(box), corner_(corner), count_(count) {}

  [[nodiscard]] bool have_common_point() const {
    if (!do_meet(box_, box_of(corner_))) return false;
    for (const Eigen::Vector3d& point : corner_)
      if (contains(box_, point)) return true;
    if (plane_parts()) return false;
    for (std::size_t side = 0; side < 3; ++side)
      for (int axis = 0; axis < 3; ++axis)
        if (side_parts(side, axis)) return false;
    return true;
  }

 private:
  [[nodiscard]] Eigen::Vector3d box_corner(unsigned index) const {
    return {(index & 1U) != 0 ? box_.max.x() : box_.min.x(), (index & 2U) != 0 ? box_.max.y() : box_.min.y(),
            (index & 4U) != 0 ? box_.max.z() : box_.min.z()};
  }
  /// Whether `side_of(corner of the box)` is one sign, other than 0, for all corners. `left_out_bits` leaves
  /// out corners that differ along one axis alone.
  template <typename SideOf>
  [[nodiscard]] bool has_all_on(int wanted, unsigned left_out_bits, const SideOf& side_of) const {
    for (unsigned index = 0; index < 8; ++index)
      if ((index & left_out_bits) == 0 && side_of(box_corner(index)) != wanted) return false;
    return true;
  }
  [[nodiscard]] bool plane_parts() const {
    const auto side_of = [&](const Eigen::Vector3d& point) {
      return decide_sign(count_, [&]<typename Number>() {
        return dot(normal_of_corners<Number>(corner_), difference<Number>(point, corner_[0]));
      });
    };
    const int first = side_of(box_.min);
    return first != 0 && has_all_on(first, 0, side_of);
  }
  /// The sign of a point's way from an origin, along the cross product of a side and a coordinate axis.
  [[nodiscard]] int way_across(std::size_t side, int axis, const Eigen::Vector3d& point,
                               const Eigen::Vector3d& origin) const {
    const int second = (axis + 1) % 3;
    const int third = (axis + 2) % 3;
    return decide_sign(count_, [&]<typename Number>() {
      const Vector<Number> edge = difference<Number>(corner_[(side + 1) % 3], corner_[side]);
      const Vector<Number> way = difference<Number>(point, origin);
      return component(edge, second) * component(way, third) -
             component(edge, third) * component(way, second);
    });
  }
  [[nodiscard]] bool side_parts(std::size_t side, int axis) const {
    const Eigen::Vector3d& on_side = corner_[side];
    const Eigen::Vector3d& across = corner_[(side + 2) % 3];
    const int way = way_across(side, axis, across, on_side);
    const unsigned along_axis = 1U << static_cast<unsigned>(axis);
    for (const int wanted : {1, -1}) {
      // The corner of the triangle that is furthest that way.
      const Eigen::Vector3d& furthest = way == wanted ? across : on_side;
      if (has_all_on(wanted, along_axis,
                     [&](const Eigen::Vector3d& point) { return way_across(side, axis, point, furthest); }))
        return true;
    }
    return false;
  }

  const Box& box_;
  const std::array<Eigen::Vector3d, 3>& corner_;
  DecisionCount& count_;
};

}  // namespace

bool meets_box(const Box& box, const Surface& surface, const FaceGroups* groups) {
  DecisionCount count;
  bool met = false;
  visit_leaves(
      surface, [&](const Box& around) { return !met && do_meet(box, around); },
      [&](const Region& leaf) {
        visit_triangles(surface, leaf, groups, [&](const TriangleOfFace& triangle) {
          met = met || BoxAndTriangle(box, corners_of(surface, triangle), count).have_common_point();
        });
      });
  return met;
}

}  // namespace graze
