#include "cast/ray_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "arithmetic/wide.hpp"

namespace graze {
namespace {

using RayTriangle = std::array<Eigen::Vector3d, 3>;

template <typename Number>
Vector<Number> along(const Ray& ray) {
  return difference<Number>(ray.head, ray.tail);
}

/// How the ray's line turns about the line through two points.
template <typename Number>
Number turn_about(const Ray& ray, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return dot(along<Number>(ray),
             cross(difference<Number>(from, ray.origin), difference<Number>(to, ray.origin)));
}

/// The t at which the ray's line meets the plane of a triangle, as a fraction.
template <typename Number>
Ratio<Number> plane_parameter(const Ray& ray, const RayTriangle& corner) {
  const Vector<Number> normal = normal_of_corners<Number>(corner);
  return {dot(normal, difference<Number>(corner[0], ray.origin)), dot(normal, along<Number>(ray))};
}

/// The quotient rounded to nearest.
double rounded_parameter(const Ray& ray, const RayTriangle& corner, DecisionCount& count) {
  const Ratio<Wide> wide = plane_parameter<Wide>(ray, corner);
  if (const auto rounded = rounded_quotient(0, wide.numerator, wide.denominator)) return *rounded;
  ++count.exact;
  const Ratio<Exact> exact = plane_parameter<Exact>(ray, corner);
  return exact.numerator.sign() == 0 ? 0 : Exact::quotient(exact.numerator, exact.denominator);
}

/// The part of a triangle that the ray's line meets, by its turns about the sides. They have one sign, and
/// are not all 0.
VoronoiRegion part_of(const std::array<int, 3>& turn) {
  if (turn[0] == 0 && turn[1] == 0) return VoronoiRegion::vertex1;
  if (turn[1] == 0 && turn[2] == 0) return VoronoiRegion::vertex2;
  if (turn[2] == 0 && turn[0] == 0) return VoronoiRegion::vertex0;
  if (turn[0] == 0) return VoronoiRegion::edge01;
  if (turn[1] == 0) return VoronoiRegion::edge12;
  return turn[2] == 0 ? VoronoiRegion::edge20 : VoronoiRegion::inside;
}

/// The first axis along which a vector is not 0, or 3.
int first_axis(const Vector<Exact>& vector) {
  for (int axis = 0; axis < 3; ++axis)
    if (component(vector, axis).sign() != 0) return axis;
  return 3;
}

/// Finds the first point of a triangle on a ray in its plane, or on one of a triangle without area. It is
/// rare, so all is done in exact arithmetic.
class MeetingInPlane {
 public:
  MeetingInPlane(const Ray& ray, const RayTriangle& corner)
      : ray_(ray), corner_(corner), along_(along<Exact>(ray)) {}

  [[nodiscard]] std::optional<RayMeeting> find() {
    if (starts_inside()) return RayMeeting{0, VoronoiRegion::inside};
    for (std::size_t side = 0; side < 3; ++side) add_side(side);
    if (!first_) return std::nullopt;
    return RayMeeting{
        first_->numerator.sign() == 0 ? 0 : Exact::quotient(first_->numerator, first_->denominator), part_};
  }

 private:
  [[nodiscard]] bool starts_inside() const {
    const Vector<Exact> normal = normal_of_corners<Exact>(corner_);
    if (first_axis(normal) == 3) return false;
    if (dot(normal, difference<Exact>(corner_[0], ray_.origin)).sign() != 0) return false;
    for (std::size_t side = 0; side < 3; ++side) {
      const Vector<Exact> edge = difference<Exact>(corner_[(side + 1) % 3], corner_[side]);
      if (dot(normal, cross(edge, difference<Exact>(ray_.origin, corner_[side]))).sign() <= 0) return false;
    }
    return true;
  }
  void add_side(std::size_t side) {
    const auto corner = [&](std::size_t index) { return static_cast<VoronoiRegion>((side + index) % 3); };
    const auto inside = static_cast<VoronoiRegion>(static_cast<std::size_t>(VoronoiRegion::edge01) + side);
    const Vector<Exact> edge = difference<Exact>(corner_[(side + 1) % 3], corner_[side]);
    const Vector<Exact> to_start = difference<Exact>(corner_[side], ray_.origin);
    const Vector<Exact> across = cross(along_, edge);
    const Vector<Exact> aside = cross(to_start, along_);
    if (const int axis = first_axis(across); axis < 3) {
      const bool flips = component(across, axis).sign() < 0;
      const Exact bottom = flips ? -component(across, axis) : component(across, axis);
      const Exact of_edge = flips ? -component(aside, axis) : component(aside, axis);
      const Exact reach = component(cross(to_start, edge), axis);
      const int beyond = (of_edge - bottom).sign();
      if (of_edge.sign() < 0 || beyond > 0) return;
      return offer({flips ? -reach : reach, bottom},
                   of_edge.sign() == 0 ? corner(0) : (beyond == 0 ? corner(1) : inside));
    }
    if (first_axis(aside) == 3) add_side_along(side, corner(0), corner(1), inside);
  }
  /// Adds a side that is on the ray's line.
  void add_side_along(std::size_t side, VoronoiRegion start, VoronoiRegion end, VoronoiRegion inside) {
    const int axis = first_axis(along_);
    const bool flips = component(along_, axis).sign() < 0;
    const Exact bottom = flips ? -component(along_, axis) : component(along_, axis);
    const auto reach_of = [&](std::size_t index) {
      const Exact reach = component(difference<Exact>(corner_[index], ray_.origin), axis);
      return flips ? -reach : reach;
    };
    const Exact to_start = reach_of(side);
    const Exact to_end = reach_of((side + 1) % 3);
    if (to_start.sign() * to_end.sign() < 0) offer({Exact(), bottom}, inside);
    offer({to_start, bottom}, start);
    offer({to_end, bottom}, end);
  }
  /// Takes a point of the triangle. If parameters are equal the lowest part counts: a corner before a side.
  void offer(const Ratio<Exact>& parameter, VoronoiRegion part) {
    if (parameter.numerator.sign() < 0) return;
    bool unsure = false;
    const int order = first_ ? compare(parameter, *first_, unsure) : -1;
    if (order > 0 || (order == 0 && part >= part_)) return;
    first_ = parameter;
    part_ = part;
  }

  const Ray& ray_;
  const RayTriangle& corner_;
  const Vector<Exact> along_;
  std::optional<Ratio<Exact>> first_;
  VoronoiRegion part_ = VoronoiRegion::inside;
};

}  // namespace

RayTriangleTest::RayTriangleTest(const Ray& ray) : ray_(ray) {
  const Eigen::Vector3d direction = ray.direction();
  direction.cwiseAbs().maxCoeff(&main_axis_);
  x_axis_ = (main_axis_ + 1) % 3;
  y_axis_ = (main_axis_ + 2) % 3;
  if (direction[main_axis_] < 0) std::swap(x_axis_, y_axis_);
  x_slope_ = direction[x_axis_] / direction[main_axis_];
  y_slope_ = direction[y_axis_] / direction[main_axis_];
}

// A turn of the ray about a side is the determinant of the direction and of the ways to two corners. Ways are
// sheared so that the direction keeps its main coordinate alone (Woop et al. 2013). Then the determinant is
// that coordinate times one of two rows.
//
// Let u be 2^-53, and F the largest coordinate of the ways. Slopes are off by 3 u. So sheared coordinates are
// at most 2 F, and off by 8 u F. Each product of a determinant is then off by 36 u F², and the determinant by
// 80 u F², which is less than 2^-46 F².
void RayTriangleTest::begin(const Box& box) {
  const double furthest =
      std::max((box.min - ray_.origin).cwiseAbs().maxCoeff(), (box.max - ray_.origin).cwiseAbs().maxCoeff());
  off_turn_ = 0x1p-46 * furthest * furthest;
  if (!(off_turn_ > 0x1p-900)) off_turn_ = std::numeric_limits<double>::infinity();
}

std::optional<RayMeeting> RayTriangleTest::meet_near(const std::array<Eigen::Vector3d, 3>& corner,
                                                     const Turns& turns, double limit,
                                                     DecisionCount& count) const {
  std::array<int, 3> sign{1, 1, 1};
  if (turns.most < -off_turn_) {
    sign = {-1, -1, -1};
  } else if (!(turns.least > off_turn_)) {
    for (std::size_t side = 0; side < 3; ++side)
      sign[side] = decide_sign(count, [&]<typename Number>() {
        return turn_about<Number>(ray_, corner[side], corner[(side + 1) % 3]);
      });
  }
  const auto [lowest, highest] = std::minmax({sign[0], sign[1], sign[2]});
  if (lowest < 0 && highest > 0) return std::nullopt;
  if (lowest == 0 && highest == 0) {
    ++count.exact;
    return MeetingInPlane(ray_, corner).find();
  }
  // The turns sum up to the denominator of the parameter.
  const int way = lowest < 0 ? -1 : 1;
  const Ratio<Ball> rough = plane_parameter<Ball>(ray_, corner);
  const double least_top = rough.numerator.value * way - rough.numerator.radius * Ball::slack;
  const double most_top = rough.numerator.value * way + rough.numerator.radius * Ball::slack;
  if (most_top < 0) return std::nullopt;
  const double most_bottom = rough.denominator.value * way + rough.denominator.radius * Ball::slack;
  if (least_top > limit * most_bottom * (1 + 0x1p-50)) return std::nullopt;
  if (!(least_top > 0) &&
      decide_sign(count, [&]<typename Number>() { return plane_parameter<Number>(ray_, corner).numerator; }) *
              way <
          0)
    return std::nullopt;
  return RayMeeting{rounded_parameter(ray_, corner, count), part_of(sign)};
}

}  // namespace graze
