#include "surface/validate_surface.hpp"

#ifdef GRAZE_VALIDATE
#include "core/base/require.hpp"
#include "core/surface/surface.hpp"

namespace graze {

void validate(const Surface& surface) {
  const IndexedMesh& mesh = surface.mesh();
  const RegionTree& tree = mesh.regions();
  for (std::uint32_t index = 0; index < tree.regions().size(); ++index) {
    const Region& region = tree.region(index);
    for (const std::uint32_t vertex : tree.vertices(region)) {
      if (surface.motion_since_vertex_refit() == 0)
        require(contains(surface.vertex_boxes()[index], surface.position(vertex)),
                "a vertex is outside its box", vertex);
      if (surface.motion_since_face_refit() == 0)
        require(contains(surface.face_boxes()[index], surface.position(vertex)),
                "a vertex is outside its surface box", vertex);
    }
    if (surface.motion_since_face_refit() != 0) continue;
    for (const std::uint32_t face : tree.faces(region))
      for (const std::uint32_t corner : mesh.face(face))
        require(contains(surface.face_boxes()[index], surface.position(corner)),
                "a face sticks out of its box", face);
    for (const std::uint32_t edge : tree.edges(region))
      for (const std::uint32_t end : mesh.edge(edge))
        require(contains(surface.face_boxes()[index], surface.position(end)), "an edge sticks out of its box",
                edge);
  }
}

void validate_blocks(const Surface& surface, const VertexBlocks& blocks) {
  std::uint32_t blocks_each = 1;
  for (std::size_t index = 0; index < blocks.level_count(); ++index) {
    const VertexBlocks::Level level = blocks.level(index);
    for (std::uint32_t block = 0; block < blocks.level(0).count; ++block)
      for (const std::uint32_t vertex : blocks.vertices(block)) {
        const Eigen::Array3d offset = surface.position(vertex) - blocks.origin();
        const Eigen::Array3d slack = offset.abs() * 0x1p-23 + 0x1p-140;
        for (int axis = 0; axis < 3; ++axis) {
          const float* const row =
              level.rows + static_cast<std::size_t>(axis) * level.stride + block / blocks_each;
          require(row[0] <= offset[axis] + slack[axis] && row[3 * level.stride] >= offset[axis] - slack[axis],
                  "a vertex is outside its block's box", vertex);
        }
      }
    blocks_each *= VertexBlocks::group_size;
  }
}

}  // namespace graze
#else
namespace graze {
void validate(const Surface& /*surface*/) {}
void validate_blocks(const Surface& /*surface*/, const VertexBlocks& /*blocks*/) {}
}  // namespace graze
#endif
