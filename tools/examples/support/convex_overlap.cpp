#include "examples/support/convex_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace examples {
namespace {

using Eigen::Vector3d;

/// Adds a direction of length 1, unless it or its opposite is there already.
void add_once(std::vector<Vector3d>& directions, const Vector3d& direction) {
  const Vector3d unit = direction.normalized();
  const auto is_same = [&](const Vector3d& other) { return std::abs(other.dot(unit)) > 1 - 1e-9; };
  if (std::none_of(directions.begin(), directions.end(), is_same)) directions.push_back(unit);
}

Vector3d normal_of(const graze::Mesh& mesh, std::uint32_t face) {
  const auto corners = mesh.face(face);
  const Vector3d& first = mesh.rest()[corners[0]];
  return (mesh.rest()[corners[1]] - first).cross(mesh.rest()[corners[2]] - first).normalized();
}

std::pair<double, double> extent(const std::vector<Vector3d>& points, const Eigen::Isometry3d& pose,
                                 const Vector3d& axis) {
  const Vector3d own_axis = pose.linear().transpose() * axis;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vector3d& point : points) {
    low = std::min(low, own_axis.dot(point));
    high = std::max(high, own_axis.dot(point));
  }
  const double offset = axis.dot(pose.translation());
  return {low + offset, high + offset};
}

}  // namespace

ConvexBody::ConvexBody(const graze::Mesh& mesh) : points_(mesh.rest().begin(), mesh.rest().end()) {
  for (const Vector3d& point : points_) radius_ = std::max(radius_, point.norm());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) add_once(normals_, normal_of(mesh, face));
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) {
    const auto faces = mesh.edge_faces(edge);
    if (normal_of(mesh, faces[0]).dot(normal_of(mesh, faces[1])) > 1 - 1e-9) continue;
    const auto [a, b] = mesh.edge(edge);
    add_once(edges_, mesh.rest()[b] - mesh.rest()[a]);
  }
}

double overlap(const ConvexBody& a, const Eigen::Isometry3d& pose_a, const ConvexBody& b,
               const Eigen::Isometry3d& pose_b) {
  double least = a.radius_ + b.radius_ - (pose_a.translation() - pose_b.translation()).norm();
  const auto try_axis = [&](const Vector3d& axis) {
    const double length = axis.norm();
    if (least < 0 || length < 1e-6) return;
    const auto [low_a, high_a] = extent(a.points_, pose_a, axis / length);
    const auto [low_b, high_b] = extent(b.points_, pose_b, axis / length);
    least = std::min({least, high_a - low_b, high_b - low_a});
  };
  for (const Vector3d& normal : a.normals_) try_axis(pose_a.linear() * normal);
  for (const Vector3d& normal : b.normals_) try_axis(pose_b.linear() * normal);
  for (const Vector3d& edge_a : a.edges_)
    for (const Vector3d& edge_b : b.edges_)
      try_axis((pose_a.linear() * edge_a).cross(pose_b.linear() * edge_b));
  return least;
}

}  // namespace examples
