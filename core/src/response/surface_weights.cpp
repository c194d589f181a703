#include <Eigen/Geometry>
#include <algorithm>
#include <graze/contact_geometry.hpp>
#include <limits>

#include "core/base/floating_point_scope.hpp"
#include "response/closest_points.hpp"
#include "response/feature_points.hpp"

namespace graze {
namespace {

using Barycentric = std::array<double, 3>;

/// Keeps the weights of a triangle that come nearest to a point.
class BestWeights {
 public:
  BestWeights(const TrianglePoints& triangle, const Eigen::Vector3d& point)
      : triangle_(triangle), point_(point) {}

  void offer(const Barycentric& weights) {
    Eigen::Vector3d sum = -point_;
    for (std::size_t i = 0; i < 3; ++i) sum += weights[i] * triangle_[i];
    const double error = sum.squaredNorm();
    if (!(error < error_)) return;
    error_ = error;
    best_ = weights;
  }
  [[nodiscard]] const Barycentric& best() const { return best_; }
  [[nodiscard]] double squared_error() const { return error_; }

 private:
  const TrianglePoints& triangle_;
  const Eigen::Vector3d& point_;
  Barycentric best_{1, 0, 0};
  double error_ = std::numeric_limits<double>::infinity();
};

/// The edges are offered besides the inside: of a triangle with next to no area the areas say nothing.
BestWeights triangle_weights(const TrianglePoints& triangle, const Eigen::Vector3d& point) {
  BestWeights best(triangle, point);
  for (std::size_t i = 0; i < 3; ++i) {
    const double end = closest_on_segment(point, {triangle[i], triangle[(i + 1) % 3]}).parameter;
    Barycentric weights{};
    weights[i] = 1 - end;
    weights[(i + 1) % 3] = end;
    best.offer(weights);
  }
  const Eigen::Vector3d normal = area_normal(triangle);
  Barycentric areas{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& from = triangle[(i + 1) % 3];
    const Eigen::Vector3d& to = triangle[(i + 2) % 3];
    areas[i] = std::max(0.0, normal.dot((to - from).cross(point - from)));
    sum += areas[i];
  }
  if (sum > 0) {
    for (double& area : areas) area /= sum;
    best.offer(areas);
  }
  return best;
}

SurfaceWeights face_weights(const PlacedMesh& placed, std::uint32_t face, const Eigen::Vector3d& point) {
  const auto corners = placed.mesh.face(face);
  SurfaceWeights result;
  result.count = static_cast<int>(corners.size());
  std::copy(corners.begin(), corners.end(), result.vertex.begin());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t triangle = 0; triangle + 2 < corners.size(); ++triangle) {
    const TrianglePoints points = triangle_of(placed, face, triangle);
    const BestWeights found = triangle_weights(points, point);
    if (triangle > 0 && !(found.squared_error() < least)) continue;
    least = found.squared_error();
    result.weight = {};
    for (std::size_t i = 0; i < 3; ++i) result.weight[triangle_corners[triangle][i]] = found.best()[i];
  }
  return result;
}

}  // namespace

SurfaceWeights weights(const Mesh& mesh, PositionView positions, const Feature& feature,
                       const Eigen::Vector3d& point) {
  const PlacedMesh placed{indexed(mesh), positions};
  check_feature(placed, feature, "weights");
  const BriefFloatingPointScope scope;
  if (feature.kind == FeatureKind::vertex) return {1, {feature.index}, {1}};
  if (feature.kind == FeatureKind::face) return face_weights(placed, feature.index, point);
  const auto [start, end] = placed.mesh.edge(feature.index);
  const double of_end = closest_on_segment(point, {placed.point(start), placed.point(end)}).parameter;
  return {2, {start, end}, {1 - of_end, of_end}};
}

}  // namespace graze
