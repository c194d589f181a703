#include "leaf_features.hpp"

#include "naming.hpp"

namespace graze {

Box box_of(const Surface& surface, Part part, std::uint32_t index) {
  const Mesh& mesh = surface.mesh();
  Box box;
  switch (part) {
    case Part::vertex:
      box.add(surface.position(index));
      break;
    case Part::edge:
      for (const std::uint32_t end : mesh.edge(index)) box.add(surface.position(end));
      break;
    case Part::face:
      for (const std::uint32_t corner : mesh.face(index)) box.add(surface.position(corner));
      break;
    case Part::fold:
      for (const std::size_t corner : {0U, 2U}) box.add(surface.position(mesh.face(index)[corner]));
      break;
  }
  return box;
}

void LeafFeatures::collect_vertices(const Surface& surface, const Region& leaf, const FilterFrame& frame,
                                    LeafVertices& corners) {
  corners.take_own(surface, leaf, frame);
  lay_out_vertices(surface, leaf, corners);
}

void LeafFeatures::collect(const Surface& surface, const Region& leaf, const FilterFrame& frame,
                           LeafVertices& corners) {
  corners.take(surface, leaf, frame);
  lay_out_vertices(surface, leaf, corners);
  lay_out_edges(surface, leaf, corners);
  lay_out_faces(surface, leaf, corners);
}

void LeafFeatures::lay_out_vertices(const Surface& surface, const Region& leaf, LeafVertices& from) {
  vertices.begin(leaf.vertex_count);
  vertices.add(surface.mesh().regions().vertices(leaf));
  from.corners.begin(leaf.vertex_count);
  for (std::uint32_t place = 0; place < leaf.vertex_count; ++place) from.corners.add(place);
  vertices.lay_out(from.data(), from.corners.padded());
}

void LeafFeatures::lay_out_edges(const Surface& surface, const Region& leaf, LeafVertices& from) {
  const auto all = surface.mesh().regions().edges(leaf);
  edges.begin(all.size());
  edges.add(all);
  from.corners.begin(2 * all.size());
  for (const std::uint32_t edge : all)
    for (const std::uint32_t end : surface.mesh().edge(edge)) from.corners.add(from.place(end));
  edges.lay_out(from.data(), from.corners.padded());
}

void LeafFeatures::lay_out_faces(const Surface& surface, const Region& leaf, LeafVertices& from) {
  const Mesh& mesh = surface.mesh();
  triangles.begin(std::size_t{2} * leaf.face_count);
  folds.begin(leaf.face_count);
  from.corners.begin(std::size_t{6} * leaf.face_count);
  from.fold_corners.begin(std::size_t{2} * leaf.face_count);
  for (const std::uint32_t face : mesh.regions().faces(leaf)) {
    const auto corner = mesh.face(face);
    const std::uint32_t first = from.place(corner[0]);
    for (std::size_t second = 1; second + 1 < corner.size(); ++second) {
      triangles.add(face);
      from.corners.add(first);
      from.corners.add(from.place(corner[second]));
      from.corners.add(from.place(corner[second + 1]));
    }
    if (corner.size() == 3 || diagonal_of(mesh, face).feature.kind != FeatureKind::face) continue;
    folds.add(face);
    from.fold_corners.add(first);
    from.fold_corners.add(from.place(corner[2]));
  }
  triangles.lay_out(from.data(), from.corners.padded());
  folds.lay_out(from.data(), from.fold_corners.padded());
}

void TakenLeaf::take_vertices(const LeafFeatures& all, const kernels::ClipBy& by,
                              kernels::BoxInFrame* found) {
  vertices.take(all.vertices, by, found);
}

void TakenLeaf::take(const LeafFeatures& all, const kernels::ClipBy& by, kernels::BoxInFrame* found) {
  vertices.take(all.vertices, by, found);
  edges.take(all.edges, by, found);
  triangles.take(all.triangles, by, found);
  folds.take(all.folds, by, found);
}

bool FoldAnswers::is_fold(const Surface& surface, std::uint32_t face, DecisionCount& count) {
  Answer& answer = answers_[face % answers_.size()];
  if (answer.surface != &surface || answer.face != face)
    answer = {&surface, face, is_folded(surface, face, count)};
  any_ = true;
  return answer.is_fold;
}

}  // namespace graze
