#pragma once

// Whether two features touch at one time, by signs of products of the vectors between their four points.
// `Signs` knows the time. It has cross(Edge, Edge, axis), the sign of a component of a cross product, and
// dot(Edge, Edge), the sign of a scalar product. Every polynomial behind these has degree 2 in time and in
// the coordinates.

namespace graze {

/// The vector from one of the four points of two features to another one.
struct Edge {
  int from;
  int to;
};

/// Which two features the four points are.
enum class SweptPair : unsigned char { vertex_face, edge_edge };

/// The first axis along which the cross product of two vectors is not 0, and the sign there. The sign is 0
/// where the vectors are parallel.
struct SignedAxis {
  int axis = 0;
  int sign = 0;
};
template <typename Signs>
SignedAxis first_axis(const Signs& signs, Edge first, Edge second) {
  for (int axis = 0; axis < 3; ++axis)
    if (const int sign = signs.cross(first, second, axis); sign != 0) return {axis, sign};
  return {};
}

/// Whether a point lies on a segment, which may be without length.
template <typename Signs>
bool lies_on_segment(const Signs& signs, int point, Edge segment) {
  const Edge first = {point, segment.from};
  const Edge second = {point, segment.to};
  return first_axis(signs, first, second).sign == 0 && signs.dot(first, second) <= 0;
}

/// Whether point 0 lies in the triangle of the points 1, 2 and 3. The four points lie in a plane.
template <typename Signs>
bool touch_vertex_face(const Signs& signs) {
  const SignedAxis area = first_axis(signs, {1, 2}, {1, 3});
  for (int i = 1; i <= 3; ++i) {
    const Edge side = {i, i % 3 + 1};
    if (area.sign == 0) {
      if (lies_on_segment(signs, 0, side)) return true;
    } else if (area.sign * signs.cross(side, {i, 0}, area.axis) < 0) {
      return false;
    }
  }
  return area.sign != 0;
}

/// Whether the segment of the points 0 and 1 and that of the points 2 and 3 have a common point. The four
/// points lie in a plane.
template <typename Signs>
bool touch_edge_edge(const Signs& signs) {
  const Edge a = {0, 1};
  const Edge b = {2, 3};
  const SignedAxis area = first_axis(signs, a, b);
  if (area.sign == 0)
    return lies_on_segment(signs, 0, b) || lies_on_segment(signs, 1, b) || lies_on_segment(signs, 2, a) ||
           lies_on_segment(signs, 3, a);
  return signs.cross(a, {0, 2}, area.axis) * signs.cross(a, {0, 3}, area.axis) <= 0 &&
         signs.cross(b, {2, 0}, area.axis) * signs.cross(b, {2, 1}, area.axis) <= 0;
}

template <typename Signs>
bool touch(SweptPair pair, const Signs& signs) {
  return pair == SweptPair::vertex_face ? touch_vertex_face(signs) : touch_edge_edge(signs);
}

}  // namespace graze
