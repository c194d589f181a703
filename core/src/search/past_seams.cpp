#include "search/past_seams.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "closest_features/lean.hpp"
#include "closest_features/seen_faces.hpp"

namespace graze {
namespace {

/// One of the two surfaces, with the groups of its faces.
class SurfaceWithSeams {
 public:
  SurfaceWithSeams(const Surface& surface, const FaceGroups& groups) : surface_(surface), groups_(groups) {}

  /// Whether `way`, of length 1, leads past a seam that has the feature. The surface goes on to both sides of
  /// a vertex of a seam. So for a vertex the way may also lead back over the seen face.
  [[nodiscard]] bool leads_past(const Feature& feature, const Eigen::Vector3d& way) const {
    if (!groups_.hides_some()) return false;
    if (feature.kind == FeatureKind::edge) return leads_past_edge(feature.index, way);
    if (feature.kind == FeatureKind::face) return false;
    const IndexedMesh& mesh = surface_.mesh();
    for (const std::uint32_t face : mesh.vertex_faces(feature.index)) {
      if (groups_.hides(face)) continue;
      for (const std::uint32_t edge : mesh.face_edges(face))
        if (edge != IndexedMesh::no_edge && has(mesh.edge(edge), feature.index) &&
            (leads_past_edge(edge, way) || leads_past_edge(edge, -way)))
          return true;
    }
    return false;
  }

 private:
  template <typename Vertices>
  static bool has(const Vertices& vertices, std::uint32_t vertex) {
    return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end();
  }
  [[nodiscard]] bool leads_past_edge(std::uint32_t edge, const Eigen::Vector3d& way) const {
    const IndexedMesh& mesh = surface_.mesh();
    const SeenFaces seen = seen_faces(groups_, mesh, edge);
    if (!seen.are_at_seam()) return false;
    const std::array<std::uint32_t, 2> ends = mesh.edge(edge);
    for (const std::uint32_t corner : mesh.edge_across(edge))
      if (is_across_in(mesh, seen.faces[0], edge, corner) && leads_past(ends, corner, way)) return true;
    return false;
  }
  /// Whether `way` leads away from a corner across an edge.
  [[nodiscard]] bool leads_past(const std::array<std::uint32_t, 2>& ends, std::uint32_t corner,
                                const Eigen::Vector3d& way) const {
    const Eigen::Vector3d start = surface_.position(ends[0]);
    const Eigen::Vector3d along = surface_.position(ends[1]) - start;
    return leads_along(square_to(along, surface_.position(corner) - start), -way);
  }

  const Surface& surface_;
  const FaceGroups& groups_;
};

/// Whether the contact's vertex is inside a solid. The sides of solids have been set.
bool is_inside(const PairQuery& query, const Contact& contact) {
  const bool a_is_inside =
      query.b_is_solid && contact.feature_a.kind == FeatureKind::vertex && contact.side_b == Side::back;
  const bool b_is_inside =
      query.a_is_solid && contact.feature_b.kind == FeatureKind::vertex && contact.side_a == Side::back;
  return a_is_inside || b_is_inside;
}

}  // namespace

void leave_out_past_seams(const SurfacePair& pair, const PairQuery& query, PairAnswer& answer) {
  if (pair.groups == nullptr) return;
  const SurfaceWithSeams a(pair.a, pair.groups->of_a());
  const SurfaceWithSeams b(pair.b, pair.groups->of_b());
  std::erase_if(answer.contacts, [&](const Contact& contact) {
    if (contact.distance == 0 || is_inside(query, contact)) return false;
    return a.leads_past(contact.feature_a, contact.normal) ||
           b.leads_past(contact.feature_b, -contact.normal);
  });
}

}  // namespace graze
