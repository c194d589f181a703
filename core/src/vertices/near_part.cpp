#include "vertices/near_part.hpp"

#include <algorithm>
#include <bit>

#include "core/mesh/pair_room.hpp"
#include "vertices/validate_near_part.hpp"

namespace graze {
namespace {

constexpr std::size_t group_vertices = VertexBlocks::group_vertices;
constexpr std::size_t bits_each = 64;

/// The vertices of all marked groups, in the mesh's order. Clears the marks.
void take_groups(const IndexedMesh& mesh, NearPart& part) {
  const auto all = mesh.block_order();
  part.order.clear();
  for (std::size_t word = 0; word < part.groups.size(); ++word)
    for (; part.groups[word] != 0; part.groups[word] &= part.groups[word] - 1) {
      const std::size_t group =
          word * bits_each + static_cast<std::size_t>(std::countr_zero(part.groups[word]));
      const auto vertices =
          all.subspan(group * group_vertices, std::min(group_vertices, all.size() - group * group_vertices));
      part.order.insert(part.order.end(), vertices.begin(), vertices.end());
    }
}

}  // namespace

void make_near_part(const Surface& surface, const Box& box, float reach, NearPart& part) {
  const IndexedMesh& mesh = surface.mesh();
  const VertexStretches& stretches = surface.stretches();
  part.stretches.count = kernels::filter().meeting(
      rows_of(stretches), nullptr, stretches.stride() / VertexBlocks::group_size,
      box_about(stretches.origin(), box, reach), part.stretches.room_for(stretches.stride()));
  part.groups.resize(mesh.block_order().size() / (group_vertices * bits_each) + 1);
  for (const std::uint32_t stretch : part.stretches.listed())
    for (const std::uint32_t group : mesh.stretch_groups(stretch))
      part.groups[group / bits_each] |= std::uint64_t{1} << (group % bits_each);
  take_groups(mesh, part);
  validate_near_part(surface, box, double{reach}, part.order);
  part.blocks.make(part.order, surface.positions());
}

void NearPart::reserve(const PairRoom& room) {
  if (room.vertices <= most_without_stretches) return;
  blocks.reserve(room.vertices);
  order.reserve(room.vertices);
  stretches.reserve(VertexBlocks::in_whole_groups(room.vertices / VertexStretches::stretch_size + 1));
  groups.reserve(room.vertices / (group_vertices * bits_each) + 1);
}

}  // namespace graze
