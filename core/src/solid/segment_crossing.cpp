#include "solid/segment_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace graze {
namespace {

using Plain = Vector<double>;

/// The sign of `vector.operator()<Number>()` times (1, δ, δ²): that of its first component that is not 0.
template <typename VectorOf>
int sign_along_nudge(DecisionCount& count, const VectorOf& vector) {
  return decide(count, [&]<typename Number>(bool& unsure) {
    const Vector<Number> asked = vector.template operator()<Number>();
    for (const Number* const part : {&asked.x, &asked.y, &asked.z})
      if (const int found = sign(*part, unsure); found != 0 || unsure) return found;
    return 0;
  });
}

/// Questions about a segment and a triangle, whose answers are those for a nudged triangle where they would
/// be 0.
class NudgedTriangle {
 public:
  NudgedTriangle(const std::array<Eigen::Vector3d, 2>& segment, const std::array<Eigen::Vector3d, 3>& corner,
                 Nudge nudge, DecisionCount& count)
      : segment_(segment), corner_(corner), nudge_(nudge == Nudge::triangle_up ? 1 : -1), count_(count) {}

  /// On which side of the triangle's plane an end of the segment is, without a nudge.
  [[nodiscard]] int side_of(const Eigen::Vector3d& end) const {
    return decide_sign(count_, [&]<typename Number>() {
      return dot(normal<Number>(), difference<Number>(end, corner_[0]));
    });
  }
  /// The side of an end that is in the plane, after the nudge. It is 0 if the triangle has no area.
  [[nodiscard]] int nudged_side() const {
    return -nudge_ * sign_along_nudge(count_, [&]<typename Number>() { return normal<Number>(); });
  }
  /// How the segment turns about the side from a corner to the next: as its second end's side of the plane,
  /// if it passes within. The segment is not parallel to the side.
  [[nodiscard]] int turn_about(std::size_t side) const {
    const Eigen::Vector3d& p = segment_[0];
    const Eigen::Vector3d& q = segment_[1];
    const Eigen::Vector3d& from = corner_[side];
    const Eigen::Vector3d& to = corner_[(side + 1) % 3];
    const int turn = decide_sign(count_, [&]<typename Number>() {
      return dot(difference<Number>(q, p), cross(difference<Number>(from, p), difference<Number>(to, p)));
    });
    if (turn != 0) return turn;
    return nudge_ * sign_along_nudge(count_, [&]<typename Number>() {
             return cross(difference<Number>(to, from), difference<Number>(q, p));
           });
  }

 private:
  template <typename Number>
  [[nodiscard]] Vector<Number> normal() const {
    return normal_of_corners<Number>(corner_);
  }

  const std::array<Eigen::Vector3d, 2>& segment_;
  const std::array<Eigen::Vector3d, 3>& corner_;
  int nudge_;
  DecisionCount& count_;
};

}  // namespace

CrossingWay crossing_way(const std::array<Eigen::Vector3d, 2>& segment,
                         const std::array<Eigen::Vector3d, 3>& triangle, Nudge nudge, DecisionCount& count) {
  const NudgedTriangle nudged(segment, triangle, nudge, count);
  int first = nudged.side_of(segment[0]);
  int second = nudged.side_of(segment[1]);
  if (first == second) return CrossingWay::none;  // also where both are 0: a nudge takes them to one side
  if (first == 0) first = nudged.nudged_side();
  if (second == 0) second = nudged.nudged_side();
  if (first == second) return CrossingWay::none;
  for (std::size_t side = 0; side < 3; ++side)
    if (nudged.turn_about(side) != second) return CrossingWay::none;
  return second > 0 ? CrossingWay::to_front : CrossingWay::to_back;
}

LastingCrossing lasting_crossing(const std::array<Eigen::Vector3d, 2>& segment,
                                 const std::array<Eigen::Vector3d, 3>& triangle, double distance) {
  const Plain u = difference<double>(triangle[1], triangle[0]);
  const Plain v = difference<double>(triangle[2], triangle[0]);
  const Plain along = difference<double>(segment[1], segment[0]);
  const std::array<Plain, 3> to{difference<double>(triangle[0], segment[0]),
                                difference<double>(triangle[1], segment[0]),
                                difference<double>(triangle[2], segment[0])};
  const Plain to_second = difference<double>(segment[1], triangle[0]);
  const double sides = std::max(dot(u, u), dot(v, v));
  const double furthest =
      std::max({dot(to[0], to[0]), dot(to[1], to[1]), dot(to[2], to[2]), dot(to_second, to_second)});
  const double length_squared = dot(along, along);
  const auto is_in_range = [](double squared) { return squared > 0x1p-200 && squared < 0x1p200; };
  if (!is_in_range(sides) || !is_in_range(furthest) || !is_in_range(length_squared))
    return LastingCrossing::unsure;
  // The bounds of `certain_passing`, and what a motion by the distance adds at most.
  constexpr double roundoff = 0x1p-53;
  const double off_side = (16 * roundoff * std::sqrt(furthest) + 2 * distance) * sides;
  const double off_turn =
      (16 * roundoff * std::sqrt(furthest) + 4 * distance) * std::sqrt(furthest * length_squared);
  const Plain normal = cross(u, v);
  const double first = -dot(normal, to[0]);
  const double second = dot(normal, to_second);
  if (!(std::abs(first) > off_side && std::abs(second) > off_side)) return LastingCrossing::unsure;
  if ((first > 0) == (second > 0)) return LastingCrossing::none;
  constexpr double least_slope = 0x1p20;  // a millionth
  bool is_certain = std::abs(second - first) > least_slope * off_side;
  for (std::size_t side = 0; side < 3; ++side) {
    const double turn = dot(along, cross(to[side], to[(side + 1) % 3]));
    if (!(std::abs(turn) > off_turn))
      is_certain = false;
    else if ((turn > 0) != (second > 0))
      return LastingCrossing::none;
  }
  if (!is_certain) return LastingCrossing::unsure;
  return second > 0 ? LastingCrossing::to_front : LastingCrossing::to_back;
}

}  // namespace graze
