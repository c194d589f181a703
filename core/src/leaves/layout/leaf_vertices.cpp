#include "leaves/layout/leaf_vertices.hpp"

#include "core/mesh/pair_room.hpp"
#include "leaves/layout/listed_vertices.hpp"

namespace graze {

void LeafVertices::load_own(const Surface& surface, const Region& leaf, const FilterFrame& frame) {
  local_.clear();
  add(surface, surface.mesh().regions().vertices(leaf), frame);
}

void LeafVertices::load(const Surface& surface, const Region& leaf, const FilterFrame& frame) {
  load_own(surface, leaf, frame);
  add(surface, surface.mesh().regions().border(leaf), frame);
}

void LeafVertices::add(const Surface& surface, std::span<const std::uint32_t> vertices,
                       const FilterFrame& frame) {
  const std::size_t first = local_.size();
  local_.resize(first + vertices.size());
  to_frame(surface, vertices, frame, local_.data() + first);
}

void LeafVertices::reserve(const PairRoom& room) {
  // An edge and a face have a corner of the leaf's own.
  local_.reserve(room.leaf_vertices + room.leaf_edges + 3 * room.leaf_faces);
  corners.reserve(std::max(room.leaf_vertices, 2 * room.leaf_faces));
}

}  // namespace graze
