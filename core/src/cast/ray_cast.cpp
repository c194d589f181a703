#include "core/cast/ray_cast.hpp"

#include "arithmetic/direction.hpp"
#include "cast/ray_triangle.hpp"
#include "cast/region_cast.hpp"
#include "cast/triangles.hpp"

namespace graze {

Feature feature_of_part(const IndexedMesh& mesh, const TriangleOfFace& triangle, VoronoiRegion part) {
  const auto corner = mesh.face(triangle.face);
  const auto edges = mesh.face_edges(triangle.face);
  const bool is_quad = corner.size() == 4;
  const auto edge = [&](std::size_t index) { return Feature{FeatureKind::edge, edges[index]}; };
  const auto vertex = [&](std::size_t index) { return Feature{FeatureKind::vertex, corner[index]}; };
  switch (part) {
    case VoronoiRegion::vertex0:
      return vertex(0);
    case VoronoiRegion::vertex1:
      return vertex(triangle.second + std::size_t{1});
    case VoronoiRegion::vertex2:
      return vertex(triangle.second + std::size_t{2});
    case VoronoiRegion::edge01:
      return triangle.second == 0 ? edge(0) : diagonal_of(mesh, triangle.face).feature;
    case VoronoiRegion::edge12:
      return edge(triangle.second + std::size_t{1});
    case VoronoiRegion::edge20:
      if (triangle.second == 1) return edge(3);
      return is_quad ? diagonal_of(mesh, triangle.face).feature : edge(2);
    case VoronoiRegion::inside:
    case VoronoiRegion::no_area:
      break;
  }
  return {FeatureKind::face, triangle.face};
}

void cast_ray(const Ray& ray, const Surface& surface, const FaceGroups* groups, HitSink& sink) {
  DecisionCount count;
  RayTriangleTest test(ray);
  const auto use = [&](const Region& leaf) {
    test.begin(surface.face_boxes()[surface.mesh().regions().number(leaf)]);
    visit_triangles(surface, leaf, groups, [&](const TriangleOfFace& triangle) {
      const auto met = test.meet(corners_of(surface, triangle), sink.limit(), count);
      if (met && met->t <= sink.limit())
        sink.take({met->t, feature_of_part(surface.mesh(), triangle, met->part), triangle});
    });
  };
  visit_leaves_along(
      ray, surface, 0, [&] { return sink.limit(); }, use);
}

Eigen::Vector3d triangle_normal(const Surface& surface, const TriangleOfFace& triangle) {
  DecisionCount count;
  const auto corner = corners_of(surface, triangle);
  const auto normal =
      unit_direction(count, [&]<typename Number>() { return normal_of_corners<Number>(corner); });
  return normal.value_or(Eigen::Vector3d::Zero());
}

}  // namespace graze
