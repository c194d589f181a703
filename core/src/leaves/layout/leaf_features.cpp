#include "leaves/layout/leaf_features.hpp"

#include "closest_features/closest_features.hpp"

namespace graze {

Box box_of(const Surface& surface, FeatureRefKind kind, std::uint32_t index) {
  const IndexedMesh& mesh = surface.mesh();
  Box box;
  switch (kind) {
    case FeatureRefKind::vertex:
      box.add(surface.position(index));
      break;
    case FeatureRefKind::edge:
      for (const std::uint32_t end : mesh.edge(index)) box.add(surface.position(end));
      break;
    case FeatureRefKind::face:
      for (const std::uint32_t corner : mesh.face(index)) box.add(surface.position(corner));
      break;
    case FeatureRefKind::fold:
      for (const std::size_t corner : {0U, 2U}) box.add(surface.position(mesh.face(index)[corner]));
      break;
  }
  return box;
}

void LeafFeatures::collect_vertices(const Surface& surface, const Region& leaf, const FilterFrame& frame,
                                    LeafVertices& corners) {
  corners.load_own(surface, leaf, frame);
  lay_out_vertices(surface, leaf, corners);
}

void LeafFeatures::collect(const Surface& surface, const Region& leaf, const FilterFrame& frame,
                           LeafVertices& corners) {
  corners.load(surface, leaf, frame);
  lay_out_vertices(surface, leaf, corners);
  lay_out_edges(surface, leaf, corners);
  lay_out_faces(surface, leaf, corners);
}

void LeafFeatures::lay_out_vertices(const Surface& surface, const Region& leaf, LeafVertices& from) {
  vertices.begin(leaf.vertex_count);
  vertices.add(surface.mesh().regions().vertices(leaf));
  from.corners.begin(leaf.vertex_count);
  for (std::uint32_t vertex_index = 0; vertex_index < leaf.vertex_count; ++vertex_index)
    from.corners.add(vertex_index);
  vertices.lay_out(from.data(), from.corners.padded());
}

void LeafFeatures::lay_out_edges(const Surface& surface, const Region& leaf, const LeafVertices& from) {
  const RegionTree& tree = surface.mesh().regions();
  edges.begin(leaf.edge_count);
  edges.add(tree.edges(leaf));
  edges.lay_out(from.data(), tree.edge_ends(leaf).data());
}

void LeafFeatures::lay_out_faces(const Surface& surface, const Region& leaf, LeafVertices& from) {
  const RegionTree& tree = surface.mesh().regions();
  const auto corners = tree.triangle_corners(leaf);
  const std::size_t triangle_count = corners.size() / 3;
  triangles.begin(triangle_count);
  folds.begin(triangle_count - leaf.face_count);
  if (triangle_count == leaf.face_count)
    triangles.add(tree.faces(leaf));
  else
    lay_out_folds(surface.mesh(), leaf, from);
  triangles.lay_out(from.data(), corners.data());
}

/// And adds the triangles that these are between.
void LeafFeatures::lay_out_folds(const IndexedMesh& mesh, const Region& leaf, LeafVertices& from) {
  const std::uint32_t* corner = mesh.regions().triangle_corners(leaf).data();
  from.corners.begin(std::size_t{2} * leaf.face_count);
  for (const std::uint32_t face : mesh.regions().faces(leaf)) {
    const std::size_t of_face = mesh.face(face).size() - 2;
    for (std::size_t triangle = 0; triangle < of_face; ++triangle) triangles.add(face);
    if (of_face == 2 && diagonal_of(mesh, face).feature.kind == FeatureKind::face) {
      folds.add(face);
      from.corners.add(corner[0]);
      from.corners.add(corner[2]);
    }
    corner += 3 * of_face;
  }
  folds.lay_out(from.data(), from.corners.padded());
}

void SelectedLeaf::select_near_vertices(const LeafFeatures& all, const kernels::ClipBy& by,
                                        kernels::BoxInFrame* found) {
  vertices.select_near(all.vertices, by, found);
}

void SelectedLeaf::select_near(const LeafFeatures& all, const kernels::ClipBy& by,
                               kernels::BoxInFrame* found) {
  vertices.select_near(all.vertices, by, found);
  edges.select_near(all.edges, by, found);
  triangles.select_near(all.triangles, by, found);
  folds.select_near(all.folds, by, found);
}

bool FoldAnswers::is_fold(const Surface& surface, std::uint32_t face, DecisionCount& count) {
  Answer& answer = answers_[face % answers_.size()];
  if (answer.surface != &surface || answer.face != face)
    answer = {&surface, face, is_folded(surface, face, count)};
  any_ = true;
  return answer.is_fold;
}

}  // namespace graze
