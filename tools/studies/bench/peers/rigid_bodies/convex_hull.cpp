#include "bench/peers/rigid_bodies/convex_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace graze::bench {
namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

/// Returns the corners of the convex polygon around points of a plane, in turn (Andrew's monotone chain).
std::vector<std::uint32_t> polygon_of(Points points, std::vector<std::uint32_t> indices,
                                      const Vector3d& normal, double tolerance) {
  const Vector3d x = normal.unitOrthogonal();
  const Vector3d y = normal.cross(x);
  std::ranges::sort(indices, {},
                    [&](std::uint32_t i) { return std::pair(points[i].dot(x), points[i].dot(y)); });
  std::vector<std::uint32_t> corners;
  const auto add = [&](std::uint32_t index, std::size_t least) {
    while (corners.size() >= least) {
      const Vector3d& last = points[corners.back()];
      const Vector3d side = last - points[corners[corners.size() - 2]];
      if (normal.dot(side.cross(points[index] - last)) > tolerance * side.norm()) break;
      corners.pop_back();
    }
    corners.push_back(index);
  };
  for (const std::uint32_t index : indices) add(index, 2);
  const std::size_t least = corners.size() + 1;
  for (auto it = indices.rbegin() + 1; it != indices.rend(); ++it) add(*it, least);
  corners.pop_back();
  return corners;
}

/// Adds the face of the plane through three points, if all points lie on one side and it is new.
void add_face(ConvexHull& hull, const Vector3d& a, const Vector3d& b, const Vector3d& c, double tolerance) {
  Vector3d normal = (b - a).cross(c - a);
  if (normal.norm() <= tolerance * (b - a).norm()) return;
  normal.normalize();
  double lowest = 0;
  double highest = 0;
  for (const Vector3d& point : hull.points) {
    const double height = normal.dot(point - a);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
    if (lowest < -tolerance && highest > tolerance) return;
  }
  if (highest > tolerance) normal = -normal;
  for (const ConvexHull::Face& face : hull.faces)
    if (face.normal.dot(normal) > 1 - 1e-9 && std::abs(face.normal.dot(a) - face.offset) <= tolerance) return;
  std::vector<std::uint32_t> on_plane;
  for (std::uint32_t i = 0; i < hull.points.size(); ++i)
    if (std::abs(normal.dot(hull.points[i] - a)) <= tolerance) on_plane.push_back(i);
  hull.faces.push_back({normal, normal.dot(a), polygon_of(hull.points, on_plane, normal, tolerance)});
}

/// Each edge is met once from each of its faces, in opposite directions.
void add_edges(ConvexHull& hull) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> face_of;
  for (std::uint32_t index = 0; index < hull.faces.size(); ++index) {
    const std::vector<std::uint32_t>& corners = hull.faces[index].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t from = corners[i];
      const std::uint32_t to = corners[(i + 1) % corners.size()];
      if (const auto other = face_of.find({to, from}); other != face_of.end())
        hull.edges.push_back({to, from, other->second, index});
      else
        face_of.emplace(std::pair(from, to), index);
    }
  }
}

}  // namespace

ConvexHull hull_of(Points points) {
  ConvexHull hull;
  hull.points.assign(points.begin(), points.end());
  double size = 0;
  for (const Vector3d& point : points) {
    hull.middle += point / static_cast<double>(points.size());
    size = std::max(size, (point - points.front()).norm());
  }
  const double tolerance = 1e-7 * size;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      for (std::size_t k = j + 1; k < points.size(); ++k)
        add_face(hull, points[i], points[j], points[k], tolerance);
  add_edges(hull);
  return hull;
}

}  // namespace graze::bench
