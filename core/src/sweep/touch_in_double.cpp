#include "sweep/touch_in_double.hpp"

#include <array>

#include "sweep/swept_vectors.hpp"

namespace graze {
namespace {

/// The sign of a number, or 0 where it is not certain or is 0.
int certain_sign(const Ball& number) {
  bool unsure = false;
  return sign(number, unsure);
}

int certain_sign(const Vector<Ball>& vector, int axis) {
  return certain_sign(component(vector, axis));
}

/// Combines what is known along each axis: one axis is enough for either answer.
template <typename AlongAxis>
CertainTouch of_axes(const AlongAxis& along_axis) {
  CertainTouch result = CertainTouch::unsure;
  for (int axis = 0; axis < 3; ++axis) {
    const CertainTouch answer = along_axis(axis);
    if (answer == CertainTouch::no) return answer;
    if (answer == CertainTouch::if_coplanar) result = answer;
  }
  return result;
}

/// The point is inside where it sees all three sides turn the same way, and outside where two of them turn
/// different ways.
CertainTouch vertex_face(const FeatureSweep& sweep, const Ball& time) {
  std::array<Vector<Ball>, 3> corner;
  for (int i = 0; i < 3; ++i)
    corner[static_cast<std::size_t>(i)] = SweptVector<Ball>(sweep, {0, i + 1}).at(time);
  const std::array<Vector<Ball>, 3> turn = {cross(corner[0], corner[1]), cross(corner[1], corner[2]),
                                            cross(corner[2], corner[0])};
  return of_axes([&](int axis) {
    int beside = 0;
    int turns = 0;
    bool differ = false;
    for (std::size_t i = 0; i < 3; ++i) {
      beside += certain_sign(corner[i], axis);
      const int here = certain_sign(turn[i], axis);
      differ = differ || here * certain_sign(turn[(i + 1) % 3], axis) < 0;
      turns += here;
    }
    if (beside == 3 || beside == -3 || differ) return CertainTouch::no;
    return turns == 3 || turns == -3 ? CertainTouch::if_coplanar : CertainTouch::unsure;
  });
}

/// The segments cross where each one has its ends on both sides of the other's line. They are apart where
/// one has both ends on one side.
CertainTouch edge_edge(const FeatureSweep& sweep, const Ball& time) {
  const auto vector = [&](int from, int to) { return SweptVector<Ball>(sweep, {from, to}).at(time); };
  const Vector<Ball> a = vector(0, 1);
  const Vector<Ball> b = vector(2, 3);
  const std::array<Vector<Ball>, 4> across = {vector(0, 2), vector(0, 3), vector(1, 2), vector(1, 3)};
  const std::array<Vector<Ball>, 4> side = {cross(a, across[0]), cross(a, across[1]), cross(b, across[0]),
                                            cross(b, across[2])};
  return of_axes([&](int axis) {
    int beside = 0;
    for (const Vector<Ball>& way : across) beside += certain_sign(way, axis);
    const int of_a = certain_sign(side[0], axis) * certain_sign(side[1], axis);
    const int of_b = certain_sign(side[2], axis) * certain_sign(side[3], axis);
    if (beside == 4 || beside == -4 || of_a > 0 || of_b > 0) return CertainTouch::no;
    return of_a < 0 && of_b < 0 ? CertainTouch::if_coplanar : CertainTouch::unsure;
  });
}

}  // namespace

CertainTouch touch_in_double(SweptPair pair, const FeatureSweep& sweep, const Ball& time) {
  return pair == SweptPair::vertex_face ? vertex_face(sweep, time) : edge_edge(sweep, time);
}

}  // namespace graze
