#include "core/sweep/swept_surface.hpp"

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// The box of a leaf's vertices, and of all corners of the faces and edges that it owns.
MovingBox box_of_way(const MovingSurface& surface, const Region& leaf) {
  const RegionTree& tree = surface.mesh().regions();
  MovingBox box;
  for (const auto vertices : {tree.vertices(leaf), tree.border(leaf)})
    for (const std::uint32_t vertex : vertices) box.add(surface.at_start(vertex), surface.at_end(vertex));
  return box;
}

}  // namespace

void SurfaceMotion::reserve(const IndexedMesh& mesh) {
  start_.reserve(mesh.vertex_count());
  boxes_.reserve(mesh.regions().region_count());
}

void SurfaceMotion::keep(const Surface& now, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t vertex = begin; vertex < end; ++vertex)
    if (now.mesh().is_used(vertex)) start_[vertex] = now.position(vertex);
}

void SurfaceMotion::finish(const Surface& now) {
  start_box_ = now.box();
  start_version_ = now.version();
}

void SurfaceMotion::make_boxes(const Surface& now, bool moves) {
  const std::uint64_t from = moves ? start_version_ : now.version();
  const RegionTree& tree = now.mesh().regions();
  const std::uint32_t count = tree.region_count();
  if (boxes_.size() == count && boxes_start_ == from && boxes_end_ == now.version()) return;
  boxes_.resize(count);
  const MovingSurface surface = way(now, moves);
  // Every child has a higher number than its parent.
  for (std::uint32_t number = count; number-- > 0;) {
    const Region& region = tree.region(number);
    MovingBox& box = boxes_[number];
    box = region.is_leaf() ? box_of_way(surface, region) : MovingBox();
    for (std::uint32_t child = 0; child < region.child_count; ++child)
      box.add(boxes_[region.first_child + child]);
  }
  boxes_start_ = from;
  boxes_end_ = now.version();
}

std::size_t SurfaceMotion::byte_count() const {
  return bytes_of(start_) + bytes_of(boxes_);
}

}  // namespace graze
