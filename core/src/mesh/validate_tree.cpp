#include "mesh/validate_tree.hpp"

#ifdef GRAZE_VALIDATE
#include <algorithm>
#include <vector>

#include "core/base/require.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/mesh/region_tree.hpp"

namespace graze {
namespace {

void require_each_once(std::span<const std::uint32_t> values, std::size_t count, std::size_t limit,
                       const char* what) {
  std::vector<bool> seen(limit, false);
  for (const std::uint32_t value : values) {
    require(value < limit && !seen[value], what, value);
    seen[value] = true;
  }
  require(values.size() == count, what, values.size());
}

/// Checks that a leaf's local indices give the corners of its edges and triangles.
void validate_places(const RegionTree& tree, const Region& leaf, const IndexedMesh& mesh) {
  const auto members = tree.vertices(leaf);
  const auto border = tree.border(leaf);
  const auto vertex_at = [&](std::uint32_t local_index) {
    return local_index < members.size() ? members[local_index] : border[local_index - members.size()];
  };
  const std::uint32_t* end = tree.edge_ends(leaf).data();
  for (const std::uint32_t edge : tree.edges(leaf))
    for (const std::uint32_t vertex : mesh.edge(edge))
      require(vertex_at(*end++) == vertex, "an edge's end is another", edge);
  const std::uint32_t* corner = tree.triangle_corners(leaf).data();
  for (const std::uint32_t face : tree.faces(leaf)) {
    const auto of_face = mesh.face(face);
    for (std::size_t second = 1; second + 1 < of_face.size(); ++second)
      for (const std::size_t at : {std::size_t{0}, second, second + 1})
        require(vertex_at(*corner++) == of_face[at], "a triangle's corner is another", face);
  }
}

}  // namespace

void validate(const RegionTree& tree, const IndexedMesh& mesh) {
  std::size_t used = 0;
  for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex)
    if (mesh.is_used(vertex)) ++used;
  require_each_once(tree.vertices(), used, mesh.vertex_count(), "a used vertex is not in the tree once");
  require_each_once(tree.faces(), mesh.face_count(), mesh.face_count(), "a face is not in the tree once");
  require_each_once(tree.edges(), mesh.edge_count(), mesh.edge_count(), "an edge is not in the tree once");
  for (std::uint32_t index = 0; index < tree.regions().size(); ++index) {
    const Region& region = tree.region(index);
    const auto members = tree.vertices(region);
    require(std::find(members.begin(), members.end(), region.middle) != members.end(),
            "a middle vertex is elsewhere", index);
    if (region.is_leaf()) validate_places(tree, region, mesh);
    std::uint32_t vertex = region.first_vertex;
    std::uint32_t face = region.first_face;
    std::uint32_t edge = region.first_edge;
    for (std::uint32_t i = 0; i < region.child_count; ++i) {
      const Region& child = tree.region(region.first_child + i);
      require(region.first_child > index && child.parent == index && child.level == region.level + 1,
              "a child is not its parent's", index);
      require(child.first_vertex == vertex && child.first_face == face && child.first_edge == edge,
              "children leave a gap", index);
      vertex += child.vertex_count;
      face += child.face_count;
      edge += child.edge_count;
    }
    if (region.is_leaf()) continue;
    require(vertex == region.first_vertex + region.vertex_count &&
                face == region.first_face + region.face_count &&
                edge == region.first_edge + region.edge_count,
            "children do not make up their parent", index);
  }
}

}  // namespace graze
#else
namespace graze {
void validate(const RegionTree& /*tree*/, const IndexedMesh& /*mesh*/) {}
}  // namespace graze
#endif
