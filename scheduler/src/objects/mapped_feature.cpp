#include "objects/mapped_feature.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace graze {
namespace {

/// The vertices of a feature, ascending and each once.
struct VertexSet {
  std::array<std::uint32_t, 4> vertex{};
  std::size_t count = 0;

  void add(std::uint32_t added) {
    std::uint32_t* const end = vertex.data() + count;
    std::uint32_t* const place = std::lower_bound(vertex.data(), end, added);
    if (place != end && *place == added) return;
    std::copy_backward(place, end, end + 1);
    *place = added;
    ++count;
  }
  friend bool operator==(const VertexSet&, const VertexSet&) = default;
};

VertexSet set_of(std::span<const std::uint32_t> corners) {
  VertexSet set;
  for (const std::uint32_t corner : corners) set.add(corner);
  return set;
}

/// Calls `visit(face)` with each face that has exactly these vertices, ascending, until it returns false.
template <typename Visit>
void for_each_face_of(const IndexedMesh& mesh, const VertexSet& vertices, const Visit& visit) {
  for (const std::uint32_t face : mesh.vertex_faces(vertices.vertex[0]))
    if (set_of(mesh.face(face)) == vertices && !visit(face)) return;
}

std::optional<Feature> edge_between(const IndexedMesh& mesh, std::uint32_t one, std::uint32_t other) {
  const auto [low, high] = std::minmax(one, other);
  for (const std::uint32_t face : mesh.vertex_faces(low))
    for (const std::uint32_t edge : mesh.face_edges(face))
      if (edge != IndexedMesh::no_edge && mesh.edge(edge) == std::array{low, high})
        return Feature{FeatureKind::edge, edge};
  return std::nullopt;
}

/// The new face with the same place among the faces of its vertices, or else the last one of these.
std::optional<Feature> face_with(const IndexedMesh& before, std::uint32_t old, const IndexedMesh& now,
                                 const VertexSet& vertices) {
  std::size_t earlier = 0;
  for_each_face_of(before, set_of(before.face(old)), [&](std::uint32_t face) {
    if (face < old) ++earlier;
    return face < old;
  });
  std::optional<Feature> found;
  for_each_face_of(now, vertices, [&](std::uint32_t face) {
    found = Feature{FeatureKind::face, face};
    return earlier-- > 0;
  });
  return found;
}

/// The vertices to which some old ones are mapped, or nothing if one of them is gone.
std::optional<VertexSet> mapped_set(const ReplacedMesh& replaced, std::span<const std::uint32_t> old) {
  VertexSet set;
  for (const std::uint32_t vertex : old) {
    if (replaced.new_of_old[vertex] == Mesh::no_vertex) return std::nullopt;
    set.add(replaced.new_of_old[vertex]);
  }
  return set;
}

}  // namespace

std::optional<Feature> mapped_feature(const Object& object, const Feature& feature) {
  if (object.replaced == nullptr) return feature;
  if (feature.index == Mesh::no_vertex) return std::nullopt;  // an earlier replacement has lost it
  const ReplacedMesh& replaced = *object.replaced;
  if (feature.kind == FeatureKind::vertex) {
    const std::uint32_t vertex = replaced.new_of_old[feature.index];
    if (vertex == Mesh::no_vertex) return std::nullopt;
    return Feature{FeatureKind::vertex, vertex};
  }
  if (feature.kind == FeatureKind::edge) {
    const auto ends = mapped_set(replaced, replaced.mesh->edge(feature.index));
    if (!ends || ends->count < 2) return std::nullopt;
    return edge_between(*object.mesh, ends->vertex[0], ends->vertex[1]);
  }
  const auto corners = mapped_set(replaced, replaced.mesh->face(feature.index));
  if (!corners) return std::nullopt;
  return face_with(*replaced.mesh, feature.index, *object.mesh, *corners);
}

}  // namespace graze
