#include "bench/peers/rigid_bodies/separating_axes.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace graze::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double least_sine = 1e-3;  // of two edges: below they count as parallel

/// Two boxes in the coordinates of the first one.
class TwoBoxes {
 public:
  TwoBoxes(const PlacedHull& a, const PlacedHull& b)
      : a_(a),
        b_(b),
        turn_(a.axes.transpose() * b.axes),
        size_(turn_.cwiseAbs()),
        way_(b.middle - a.middle),
        way_a_(a.axes.transpose() * way_),
        way_b_(b.axes.transpose() * way_) {}

  [[nodiscard]] std::optional<SeparatingAxes> axes(double distance) const {
    SeparatingAxes axes;
    const Vector3d by_a = way_a_.cwiseAbs() - a_.half - size_ * b_.half;
    const Vector3d by_b = way_b_.cwiseAbs() - b_.half - size_.transpose() * a_.half;
    int i = 0;
    int j = 0;
    axes.a.separation = by_a.maxCoeff(&i);
    axes.b.separation = by_b.maxCoeff(&j);
    if (axes.a.separation >= distance || axes.b.separation >= distance) return std::nullopt;
    axes.a.face = a_.face_along(way_a_[i] > 0 ? a_.axes.col(i) : Vector3d(-a_.axes.col(i)));
    axes.b.face = b_.face_along(way_b_[j] > 0 ? Vector3d(-b_.axes.col(j)) : b_.axes.col(j));
    for (i = 0; i < 3; ++i)
      for (j = 0; j < 3; ++j) {
        test_edges(i, j, axes.edges);
        if (axes.edges.separation >= distance) return std::nullopt;
      }
    return axes;
  }

 private:
  void test_edges(int i, int j, EdgeAxis& best) const {
    Vector3d normal = a_.axes.col(i).cross(b_.axes.col(j));
    const double sine = normal.norm();
    if (sine < least_sine) return;
    normal *= (normal.dot(way_) < 0 ? -1 : 1) / sine;
    const Vector3d in_a = a_.axes.transpose() * normal;
    const Vector3d in_b = b_.axes.transpose() * normal;
    const double separation = normal.dot(way_) - in_a.cwiseAbs().dot(a_.half) - in_b.cwiseAbs().dot(b_.half);
    if (separation <= best.separation) return;
    best = {separation,    normal, edge_point(a_, in_a, i), a_.axes.col(i), edge_point(b_, -in_b, j),
            b_.axes.col(j)};
  }
  /// Returns the middle of the edge along an axis that is furthest in a direction of the box's own.
  static Vector3d edge_point(const PlacedHull& box, const Vector3d& direction, int axis) {
    Vector3d point = box.half;
    for (int i = 0; i < 3; ++i)
      if (direction[i] < 0) point[i] = -point[i];
    point[axis] = 0;
    return box.middle + box.axes * point;
  }

  const PlacedHull& a_;
  const PlacedHull& b_;
  Matrix3d turn_;
  Matrix3d size_;
  Vector3d way_;  ///< from a to b
  Vector3d way_a_, way_b_;
};

FaceAxis face_axis(const PlacedHull& of, const PlacedHull& other, double distance) {
  FaceAxis best;
  for (std::uint32_t face = 0; face < of.normals.size(); ++face) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vector3d& point : other.points) lowest = std::min(lowest, of.normals[face].dot(point));
    if (lowest - of.offsets[face] > best.separation) best = {lowest - of.offsets[face], face};
    if (best.separation >= distance) break;
  }
  return best;
}

/// An edge of a placed hull, with the normals of its faces.
struct Arc {
  Arc(const PlacedHull& of, const ConvexHull::Edge& edge, double sign)
      : point(of.points[edge.from]),
        along(of.points[edge.to] - point),
        left(sign * of.normals[edge.left]),
        right(sign * of.normals[edge.right]),
        pole(left.cross(right)) {}
  Vector3d point, along;
  Vector3d left, right;
  Vector3d pole;
};

/// Whether the arcs of the normals of two edges cross, so that the edges touch in the sum of the bodies.
bool do_cross(const Arc& a, const Arc& b) {
  const double left_b = b.left.dot(a.pole);
  const double right_b = b.right.dot(a.pole);
  if (left_b * right_b >= 0) return false;
  const double left_a = a.left.dot(b.pole);
  const double right_a = a.right.dot(b.pole);
  return left_a * right_a < 0 && left_b * right_a > 0;
}

EdgeAxis edge_axis(const PlacedHull& a, const PlacedHull& b, double distance) {
  EdgeAxis best;
  std::vector<Arc> arcs_b;
  arcs_b.reserve(b.hull->edges.size());
  for (const ConvexHull::Edge& edge : b.hull->edges) arcs_b.emplace_back(b, edge, -1);
  for (const ConvexHull::Edge& edge : a.hull->edges) {
    const Arc arc_a(a, edge, 1);
    for (const Arc& arc_b : arcs_b) {
      if (!do_cross(arc_a, arc_b)) continue;
      Vector3d normal = arc_a.along.cross(arc_b.along);
      const double length = normal.norm();
      if (length < least_sine * arc_a.along.norm() * arc_b.along.norm()) continue;
      normal *= (normal.dot(arc_a.point - a.middle) < 0 ? -1 : 1) / length;
      const double separation = normal.dot(arc_b.point - arc_a.point);
      if (separation > best.separation)
        best = {separation, normal, arc_a.point, arc_a.along, arc_b.point, arc_b.along};
      if (separation >= distance) return best;
    }
  }
  return best;
}

}  // namespace

std::optional<SeparatingAxes> separating_axes(const PlacedHull& a, const PlacedHull& b, double distance) {
  if (a.is_box() && b.is_box()) return TwoBoxes(a, b).axes(distance);
  SeparatingAxes axes;
  axes.a = face_axis(a, b, distance);
  if (axes.a.separation >= distance) return std::nullopt;
  axes.b = face_axis(b, a, distance);
  if (axes.b.separation >= distance) return std::nullopt;
  axes.edges = edge_axis(a, b, distance);
  if (axes.edges.separation >= distance) return std::nullopt;
  return axes;
}

}  // namespace graze::bench
