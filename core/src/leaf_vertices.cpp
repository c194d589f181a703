#include "leaf_vertices.hpp"

#include "listed_vertices.hpp"

namespace graze {

void LeafVertices::take_own(const Surface& surface, const Region& leaf, const FilterFrame& frame) {
  local_.clear();
  if (place_of_.size() < surface.mesh().vertex_count()) place_of_.resize(surface.mesh().vertex_count());
  add(surface, surface.mesh().regions().vertices(leaf), frame);
}

void LeafVertices::take(const Surface& surface, const Region& leaf, const FilterFrame& frame) {
  take_own(surface, leaf, frame);
  add(surface, surface.mesh().regions().border(leaf), frame);
}

void LeafVertices::add(const Surface& surface, std::span<const std::uint32_t> vertices,
                       const FilterFrame& frame) {
  const std::size_t first = local_.size();
  local_.resize(first + vertices.size());
  bring(surface, vertices, frame, local_.data() + first);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    place_of_[vertices[i]] = static_cast<std::uint32_t>(first + i);
}

void LeafVertices::reserve_as(const LeafVertices& other) {
  graze::reserve_as(local_, other.local_);
  if (place_of_.size() < other.place_of_.size()) place_of_.resize(other.place_of_.size());
  corners.reserve_as(other.corners);
  fold_corners.reserve_as(other.fold_corners);
}

void LeafVertices::reserve(const PairRoom& room) {
  // An edge and a face have a corner of the leaf's own.
  local_.reserve(room.leaf_vertices + room.leaf_edges + 3 * room.leaf_faces);
  if (place_of_.size() < room.vertices) place_of_.resize(room.vertices);
  corners.reserve(std::max({room.leaf_vertices, 2 * room.leaf_edges, 6 * room.leaf_faces}));
  fold_corners.reserve(2 * room.leaf_faces);
}

}  // namespace graze
