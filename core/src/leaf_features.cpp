#include "leaf_features.hpp"

#include "naming.hpp"
#include "near_box.hpp"

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

bool LeafFeatures::collect_vertices(const Surface& surface, const Region& leaf, const Box& other,
                                    const FilterFrame& frame, double limit) {
  const NearBox near(other, limit);
  vertices.begin(leaf.vertex_count);
  for (const std::uint32_t vertex : surface.mesh().regions().vertices(leaf)) {
    const std::array point{surface.position(vertex)};
    const double gap_squared = near.gap_squared(point);
    if (near.is_near(gap_squared)) vertices.add(vertex, frame, point, gap_squared == 0);
  }
  return vertices.count() == leaf.vertex_count;
}

bool LeafFeatures::collect(const Surface& surface, const Region& leaf, const Box& other,
                           const FilterFrame& frame, double limit) {
  const Mesh& mesh = surface.mesh();
  const NearBox near(other, limit);
  bool all = collect_vertices(surface, leaf, other, frame, limit);
  const auto add = [&](auto& block, std::uint32_t owner, const auto& corners) {
    const double gap_squared = near.gap_squared(corners);
    if (near.is_near(gap_squared))
      block.add(owner, frame, corners, gap_squared == 0);
    else
      all = false;
  };
  const auto at = [&](std::uint32_t vertex) { return surface.position(vertex); };
  edges.begin(leaf.edge_count);
  for (const std::uint32_t edge : mesh.regions().edges(leaf)) {
    const auto end = mesh.edge(edge);
    add(edges, edge, std::array{at(end[0]), at(end[1])});
  }
  triangles.begin(std::size_t{2} * leaf.face_count);
  folds.begin(leaf.face_count);
  for (const std::uint32_t face : mesh.regions().faces(leaf)) {
    const auto corner = mesh.face(face);
    add(triangles, face, std::array{at(corner[0]), at(corner[1]), at(corner[2])});
    if (corner.size() == 3) continue;
    add(triangles, face, std::array{at(corner[0]), at(corner[2]), at(corner[3])});
    if (diagonal_of(mesh, face).feature.kind == FeatureKind::face)
      add(folds, face, std::array{at(corner[0]), at(corner[2])});
  }
  surface_ = &surface;
  prepare();
  return all;
}

void LeafFeatures::prepare() {
  const kernels::Filter& filter = kernels::filter();
  filter.prepare_segments(edges.data(), edges.stride(), edges.count());
  filter.prepare_segments(folds.data(), folds.stride(), folds.count());
  filter.prepare_triangles(triangles.data(), triangles.stride(), triangles.count());
  folded_.assign(folds.count(), Folded::unknown);
}

bool LeafFeatures::is_fold(std::size_t fold, DecisionCount& count) {
  Folded& folded = folded_[fold];
  if (folded == Folded::unknown)
    folded = is_folded(*surface_, folds.owner(fold), count) ? Folded::yes : Folded::no;
  return folded == Folded::yes;
}

}  // namespace graze
