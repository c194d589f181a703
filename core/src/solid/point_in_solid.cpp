#include "solid/point_in_solid.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "closest_features/closest_features.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "surface/region_visit.hpp"

namespace graze {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// On which side of the line through two corners a ray from `point` along +x passes, seen along x. The ray
/// starts at (x, y + ε, z + ε²) for a positive ε that is smaller than all numbers (Edelsbrunner and Mücke,
/// "Simulation of simplicity"). So it meets no edge and no vertex, and two triangles at an edge agree. It is
/// 0 where both corners are one, seen along x.
int side_of_ray(const Eigen::Vector3d& point, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                DecisionCount& count) {
  const int side = decide_sign(count, [&]<typename Number>() {
    const Vector<Number> along = difference<Number>(to, from);
    const Vector<Number> way = difference<Number>(point, from);
    return along.y * way.z - along.z * way.y;
  });
  if (side != 0) return side;
  if (from.z() != to.z()) return from.z() > to.z() ? 1 : -1;
  if (from.y() != to.y()) return from.y() < to.y() ? 1 : -1;
  return 0;
}

/// The sign of the volume of a point over a triangle.
int side_of_plane(const Eigen::Vector3d& point, const Triangle& triangle, DecisionCount& count) {
  return decide_sign(count, [&]<typename Number>() {
    return dot(normal_of_corners<Number>(triangle), difference<Number>(point, triangle[0]));
  });
}

/// Whether a box of the corners may hold a point of the ray. Corners level with the point are below the ray.
bool may_meet_ray(const Eigen::Vector3d& point, const Triangle& triangle) {
  const Eigen::Vector3d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
  const Eigen::Vector3d high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
  return high.x() >= point.x() && low.y() <= point.y() && low.z() <= point.z() && high.y() >= point.y() &&
         high.z() >= point.z();
}

/// Counts how often a surface winds about a point, by the triangles that a ray along +x meets.
class RayCount {
 public:
  RayCount(const Eigen::Vector3d& point, const Surface& solid, DecisionCount& count)
      : point_(point), solid_(solid), count_(count) {}
  /// Does not count a triangle that holds the point.
  void leave_out(const FeaturePiece& triangle) { without_ = triangle; }

  void add_face(std::uint32_t face) {
    const auto corner = solid_.mesh().face(face);
    bool may_hold = false;
    for (std::size_t last = 2; last < corner.size(); ++last) {
      if (without_ == face_piece(face, last == 2 ? Piece::first : Piece::second)) continue;
      const Triangle triangle = {solid_.position(corner[0]), solid_.position(corner[last - 1]),
                                 solid_.position(corner[last])};
      if (!may_meet_ray(point_, triangle)) continue;
      may_hold = may_hold || std::min({triangle[0].x(), triangle[1].x(), triangle[2].x()}) <= point_.x();
      add_triangle(triangle);
    }
    // A triangle that is seen edge on is met by no ray.
    if (may_hold && !on_surface_) on_surface_ = touches(face);
  }
  [[nodiscard]] PointInSolid location() const {
    if (on_surface_) return PointInSolid::on_surface;
    if (winding_ == 0) return PointInSolid::outside;
    return winding_ > 0 ? PointInSolid::inside : PointInSolid::inside_out;
  }
  [[nodiscard]] bool is_on_surface() const { return on_surface_; }
  [[nodiscard]] int winding() const { return winding_; }

 private:
  void add_triangle(const Triangle& triangle) {
    const int side = side_of_ray(point_, triangle[0], triangle[1], count_);
    if (side == 0 || side_of_ray(point_, triangle[1], triangle[2], count_) != side ||
        side_of_ray(point_, triangle[2], triangle[0], count_) != side)
      return;
    const int above = side_of_plane(point_, triangle, count_);
    if (above == 0) on_surface_ = true;
    if (above == -side) winding_ += side;  // the plane is met ahead, not behind
  }
  [[nodiscard]] bool touches(std::uint32_t face) const {
    SquaredRange squared;
    const FeaturePiece piece = nearest_piece_of_face(point_, solid_, face, count_, squared);
    if (squared.low > 0) return false;
    return do_touch({{1, {}, {point_}}, simplex_of(solid_, piece)}, count_);
  }

  const Eigen::Vector3d& point_;
  const Surface& solid_;
  DecisionCount& count_;
  std::optional<FeaturePiece> without_;
  int winding_ = 0;
  bool on_surface_ = false;
};

/// Visits the leaves that a ray from `point` along +x may meet.
template <typename GoesOn, typename Use>
void visit_leaves_ahead(const Eigen::Vector3d& point, const Surface& solid, const GoesOn& goes_on,
                        const Use& use) {
  visit_leaves(
      solid,
      [&](const Box& box) {
        return goes_on() && box.max.x() >= point.x() && box.min.y() <= point.y() &&
               box.max.y() >= point.y() && box.min.z() <= point.z() && box.max.z() >= point.z();
      },
      [&](const Region& leaf) {
        for (const std::uint32_t face : solid.mesh().regions().faces(leaf)) use(face);
      });
}

/// Whether a ray as of `side_of_ray`, from a point on a triangle, is in front of it once it has left it.
bool leads_to_front(const Surface& solid, const FeaturePiece& triangle, DecisionCount& count) {
  const Simplex corners = simplex_of(solid, triangle);
  for (int axis = 0; axis < 3; ++axis) {
    const int side = decide_sign(count, [&]<typename Number>() {
      const Vector<Number> normal = normal_of_corners<Number>(corners.point);
      return component(normal, axis);
    });
    if (side != 0) return side > 0;
  }
  return true;
}

}  // namespace

PointInSolid locate(const Eigen::Vector3d& point, const Surface& solid, DecisionCount& count) {
  if (!contains(solid.box(), point)) return PointInSolid::outside;
  RayCount ray(point, solid, count);
  visit_leaves_ahead(
      point, solid, [&] { return !ray.is_on_surface(); }, [&](std::uint32_t face) { ray.add_face(face); });
  return ray.location();
}

bool normal_leads_in(const Surface& solid, const FeaturePiece& triangle, const Eigen::Vector3d& point,
                     DecisionCount& count) {
  const int side = side_of_plane(point, simplex_of(solid, triangle).point, count);
  RayCount ray(point, solid, count);
  if (side == 0) ray.leave_out(triangle);
  visit_leaves_ahead(
      point, solid, [] { return true; }, [&](std::uint32_t face) { ray.add_face(face); });
  const bool is_in_front = side == 0 ? leads_to_front(solid, triangle, count) : side > 0;
  // Behind a triangle the surface winds once more than in front of it.
  return (is_in_front ? ray.winding() : ray.winding() - 1) < 0;
}

}  // namespace graze
