#include <algorithm>
#include <array>
#include <graze/mesh.hpp>
#include <map>

#include "arithmetic/arithmetic.hpp"
#include "core/base/floating_point_scope.hpp"

namespace graze {
namespace {

bool has_area(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  DecisionCount count;
  return decide(count, [&]<typename Number>(bool& unsure) {
    const Vector<Number> normal = cross(difference<Number>(mesh.rest()[b], mesh.rest()[a]),
                                        difference<Number>(mesh.rest()[c], mesh.rest()[a]));
    return sign(dot(normal, normal), unsure) != 0;
  });
}

bool is_degenerate(const Mesh& mesh, std::uint32_t index) {
  const auto corners = mesh.face(index);
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      if (corners[i] == corners[j]) return true;
  if (has_area(mesh, corners[0], corners[1], corners[2])) return false;
  return corners.size() == 3 || !has_area(mesh, corners[0], corners[2], corners[3]);
}

/// Whether every face runs along `edge` in another direction than the next. It is asked of edges of two faces
/// only.
bool is_flipped(const Mesh& mesh, std::uint32_t edge) {
  int direction = 0;
  for (const std::uint32_t face : mesh.edge_faces(edge)) {
    const auto edges = mesh.face_edges(face);
    const auto corner = static_cast<std::size_t>(std::find(edges.begin(), edges.end(), edge) - edges.begin());
    direction += mesh.face(face)[corner] == mesh.edge(edge)[0] ? 1 : -1;
  }
  return direction != 0;
}

}  // namespace

MeshOddities find_oddities(const Mesh& mesh) {
  const FloatingPointScope scope;
  MeshOddities odd;
  std::map<std::vector<std::uint32_t>, std::uint32_t> seen_faces;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    if (is_degenerate(mesh, face)) odd.degenerate_faces.push_back(face);
    std::vector<std::uint32_t> corners(mesh.face(face).begin(), mesh.face(face).end());
    std::sort(corners.begin(), corners.end());
    if (!seen_faces.try_emplace(std::move(corners), face).second) odd.duplicate_faces.push_back(face);
  }
  std::map<std::array<double, 3>, std::uint32_t> seen_positions;
  for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex) {
    const Eigen::Vector3d& position = mesh.rest()[vertex];
    if (!mesh.is_used(vertex))
      odd.isolated_vertices.push_back(vertex);
    else if (!seen_positions.try_emplace({position.x(), position.y(), position.z()}, vertex).second)
      odd.duplicate_vertices.push_back(vertex);
  }
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) {
    const std::size_t face_count = mesh.edge_faces(edge).size();
    if (face_count > 2) odd.non_manifold_edges.push_back(edge);
    if (face_count == 1) odd.border_edges.push_back(edge);
    if (face_count == 2 && is_flipped(mesh, edge)) odd.flipped_edges.push_back(edge);
  }
  return odd;
}

}  // namespace graze
