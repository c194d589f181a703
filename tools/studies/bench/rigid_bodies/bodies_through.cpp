#include "bench/rigid_bodies/bodies_through.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace graze::bench {
namespace {

using Eigen::Vector3d;

constexpr double spacing = 0.025;  // m, of points along an edge, at most

double square_distance(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  const Vector3d along = to - from;
  const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - from - share * along).squaredNorm();
}

double square_distance(const Vector3d& point, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const auto is_beside = [&](const Vector3d& from, const Vector3d& to) {
    return normal.dot((to - from).cross(point - from)) >= 0;
  };
  if (is_beside(a, b) && is_beside(b, c) && is_beside(c, a)) {
    const double height = normal.dot(point - a);
    return height * height / normal.squaredNorm();
  }
  return std::min({square_distance(point, a, b), square_distance(point, b, c), square_distance(point, c, a)});
}

/// The solid angle under which a point sees a triangle (van Oosterom and Strackee, 1983).
double solid_angle(const Vector3d& point, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d x = a - point;
  const Vector3d y = b - point;
  const Vector3d z = c - point;
  const double below =
      x.norm() * y.norm() * z.norm() + x.dot(y) * z.norm() + y.dot(z) * x.norm() + z.dot(x) * y.norm();
  return 2 * std::atan2(x.dot(y.cross(z)), below);
}

double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// Whether a segment passes through the inside of a triangle.
bool does_pierce(const Vector3d& from, const Vector3d& to, const Vector3d& a, const Vector3d& b,
                 const Vector3d& c) {
  if (volume(a, b, c, from) * volume(a, b, c, to) >= 0) return false;
  const double first = volume(from, to, a, b);
  const double second = volume(from, to, b, c);
  const double third = volume(from, to, c, a);
  return first * second > 0 && second * third > 0;
}

/// Whether a box around points reaches another one.
template <std::size_t count>
bool is_near(const std::array<Vector3d, count>& points, const Vector3d& low, const Vector3d& high) {
  for (int i = 0; i < 3; ++i) {
    const auto [least, most] =
        std::ranges::minmax(points, {}, [i](const Vector3d& point) { return point[i]; });
    if (most[i] < low[i] || least[i] > high[i]) return false;
  }
  return true;
}

}  // namespace

BodiesThrough::BodiesThrough(std::span<const RigidBodyShapePtr> shapes, double depth) : depth_(depth) {
  for (const RigidBodyShapePtr& shape : shapes) solids_.push_back(solid_of(shape->plain));
}

BodiesThrough::Solid BodiesThrough::solid_of(const RigidShape& shape) {
  Solid solid;
  for (std::size_t i = 0; i < shape.points.size(); i += 3)
    solid.own_points.emplace_back(shape.points[i], shape.points[i + 1], shape.points[i + 2]);
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const Triangle& triangle : shape.triangles) {
    const auto& [a, b, c] = triangle.corners;
    solid.triangles.push_back({a, b, c});
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      edges.insert({std::min(from, to), std::max(from, to)});
  }
  solid.edges.assign(edges.begin(), edges.end());
  for (const auto& [from, to] : edges) {
    const Vector3d start = solid.own_points[from];
    const Vector3d way = solid.own_points[to] - start;
    if (way.norm() > 5) continue;  // the floor's, whose points nobody needs
    const auto pieces = static_cast<int>(std::ceil(way.norm() / spacing));
    for (int i = 1; i < pieces; ++i) solid.own_points.emplace_back(start + way * i / pieces);
  }
  return solid;
}

void BodiesThrough::place(Solid& solid, const rigid::Body& body) {
  solid.points.clear();
  for (const Vector3d& point : solid.own_points) solid.points.push_back(body.to_world(point));
  solid.low = solid.high = solid.points.front();
  for (const Vector3d& point : solid.points) {
    solid.low = solid.low.cwiseMin(point);
    solid.high = solid.high.cwiseMax(point);
  }
}

bool BodiesThrough::is_inside(const Vector3d& point, const Solid& solid) {
  double sum = 0;
  for (const auto& [a, b, c] : solid.triangles)
    sum += solid_angle(point, solid.points[a], solid.points[b], solid.points[c]);
  return std::abs(sum) > 2 * std::numbers::pi;
}

bool BodiesThrough::is_deep(const Solid& guest, const Solid& host) const {
  return std::ranges::any_of(guest.points, [&](const Vector3d& point) {
    const bool is_in_box =
        ((point - host.low).array() > depth_).all() && ((host.high - point).array() > depth_).all();
    return is_in_box &&
           std::ranges::all_of(host.triangles,
                               [&](const auto& corners) {
                                 return square_distance(point, host.points[corners[0]],
                                                        host.points[corners[1]],
                                                        host.points[corners[2]]) > depth_ * depth_;
                               }) &&
           is_inside(point, host);
  });
}

bool BodiesThrough::does_pierce(const Solid& guest, const Solid& host) {
  const Vector3d low = guest.low.cwiseMax(host.low);
  const Vector3d high = guest.high.cwiseMin(host.high);
  std::vector<std::array<Vector3d, 3>> triangles;
  for (const auto& [a, b, c] : host.triangles) {
    const std::array corners{host.points[a], host.points[b], host.points[c]};
    if (is_near(corners, low, high)) triangles.push_back(corners);
  }
  return std::ranges::any_of(guest.edges, [&](const auto& edge) {
    const std::array ends{guest.points[edge[0]], guest.points[edge[1]]};
    if (!is_near(ends, low, high)) return false;
    return std::ranges::any_of(triangles, [&](const auto& corners) {
      return bench::does_pierce(ends[0], ends[1], corners[0], corners[1], corners[2]);
    });
  });
}

Overlaps BodiesThrough::find(std::span<const rigid::Body> bodies) {
  Overlaps overlaps;
  for (std::size_t i = 0; i < bodies.size(); ++i) place(solids_[i], bodies[i]);
  for (std::uint32_t i = 0; i < solids_.size(); ++i)
    for (std::uint32_t j = i + 1; j < solids_.size(); ++j) {
      const Solid& a = solids_[i];
      const Solid& b = solids_[j];
      if ((a.low.array() > b.high.array()).any() || (b.low.array() > a.high.array()).any()) continue;
      if (is_deep(a, b) || is_deep(b, a)) overlaps.deep.emplace_back(i, j);
      if (does_pierce(a, b) || does_pierce(b, a)) overlaps.crossing.emplace_back(i, j);
    }
  return overlaps;
}

}  // namespace graze::bench
