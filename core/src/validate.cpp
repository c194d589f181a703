#include "validate.hpp"

#ifdef GRAZE_VALIDATE
#include <algorithm>
#include <graze/leaf_front.hpp>
#include <graze/surface.hpp>
#include <stdexcept>
#include <string>

namespace graze {
namespace {

void require(bool holds, const char* what, std::size_t index) {
  if (!holds)
    throw std::logic_error(std::string("graze validator: ") + what + " at " + std::to_string(index));
}

void require_each_once(std::span<const std::uint32_t> values, std::size_t count, std::size_t limit,
                       const char* what) {
  std::vector<bool> seen(limit, false);
  for (const std::uint32_t value : values) {
    require(value < limit && !seen[value], what, value);
    seen[value] = true;
  }
  require(values.size() == count, what, values.size());
}

bool contains(const Box& box, const Eigen::Vector3d& point) {
  return (point.array() >= box.min.array()).all() && (point.array() <= box.max.array()).all();
}

}  // namespace

void validate(const RegionTree& tree, const Mesh& mesh) {
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

void validate(const Surface& surface) {
  const Mesh& mesh = surface.mesh();
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
      require(contains(surface.face_boxes()[index], surface.position(mesh.edge(edge)[1])),
              "an edge sticks out of its box", edge);
  }
}

void validate(const LeafFront& front, const Surface& a, const Surface& b) {
  const auto regions_a = a.mesh().regions().regions();
  const auto regions_b = b.mesh().regions().regions();
  const double beyond = front.beyond_now(a, b);
  if (!(beyond > 0) || regions_a.size() * regions_b.size() > 4096) return;
  for (std::uint32_t i = 0; i < regions_a.size(); ++i)
    for (std::uint32_t j = 0; j < regions_b.size(); ++j) {
      if (!regions_a[i].is_leaf() || !regions_b[j].is_leaf()) continue;
      const bool listed =
          std::any_of(front.leaves.begin(), front.leaves.end(),
                      [&](const RegionPair& leaves) { return leaves.a == i && leaves.b == j; });
      const double lower = lower_distance(a.face_box_now(regions_a[i]), b.face_box_now(regions_b[j]));
      require(listed || lower >= beyond * (1 - 0x1p-40), "a front misses leaves", i);
    }
}

}  // namespace graze
#else
namespace graze {
void validate(const RegionTree& /*tree*/, const Mesh& /*mesh*/) {}
void validate(const Surface& /*surface*/) {}
void validate(const LeafFront& /*front*/, const Surface& /*a*/, const Surface& /*b*/) {}
}  // namespace graze
#endif
