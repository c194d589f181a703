#include "validate.hpp"

#ifdef GRAZE_VALIDATE
#include <algorithm>
#include <graze/leaf_front.hpp>
#include <graze/surface.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bounds.hpp"

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

using Points = std::vector<Eigen::Vector3d>;

/// Where vertices are now, each once.
Points points_of(const Surface& surface, std::vector<std::uint32_t> vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Points points;
  for (const std::uint32_t vertex : vertices) points.push_back(surface.position(vertex));
  return points;
}

/// What a leaf owns, by its corners.
struct CornersOf {
  Points vertices;
  Points faces;
  Points edges;

  CornersOf(const Surface& surface, const Region& leaf) {
    const Mesh& mesh = surface.mesh();
    const RegionTree& tree = mesh.regions();
    const auto members = tree.vertices(leaf);
    std::vector<std::uint32_t> of_faces;
    for (const std::uint32_t face : tree.faces(leaf))
      for (const std::uint32_t corner : mesh.face(face)) of_faces.push_back(corner);
    std::vector<std::uint32_t> of_edges;
    for (const std::uint32_t edge : tree.edges(leaf))
      for (const std::uint32_t end : mesh.edge(edge)) of_edges.push_back(end);
    vertices = points_of(surface, {members.begin(), members.end()});
    faces = points_of(surface, std::move(of_faces));
    edges = points_of(surface, std::move(of_edges));
  }
};

/// A leaf's lists of places give the corners of its edges and triangles.
void validate_places(const RegionTree& tree, const Region& leaf, const Mesh& mesh) {
  const auto members = tree.vertices(leaf);
  const auto border = tree.border(leaf);
  const auto vertex_at = [&](std::uint32_t place) {
    return place < members.size() ? members[place] : border[place - members.size()];
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

void require_apart(const Points& a, const Points& b, double lower, const char* what, std::size_t index) {
  for (const Eigen::Vector3d& point_a : a)
    for (const Eigen::Vector3d& point_b : b) require(upper_distance(point_a, point_b) >= lower, what, index);
}

void require_apart(const CornersOf& a, const CornersOf& b, double lower, const char* what,
                   std::size_t index) {
  for (const Points* const of_a : {&a.vertices, &a.faces, &a.edges})
    for (const Points* const of_b : {&b.vertices, &b.faces, &b.edges})
      require_apart(*of_a, *of_b, lower, what, index);
}

/// Of each vertex and face and each two edges: of two corners that neither leaf owns it is another pair of
/// leaves that is looked into.
void require_features_apart(const CornersOf& a, const CornersOf& b, double lower, const char* what,
                            std::size_t index) {
  require_apart(a.vertices, b.faces, lower, what, index);
  require_apart(a.faces, b.vertices, lower, what, index);
  require_apart(a.edges, b.edges, lower, what, index);
}

double lower_now(const Surface& a, const Region& leaf_a, const Surface& b, const Region& leaf_b) {
  return lower_distance(a.box_now(leaf_a, RefitOf::faces), b.box_now(leaf_b, RefitOf::faces));
}

void validate_listed(const ListedLeaves& listed, const LeafFront& front, const Surface& a, const Surface& b) {
  const Region& leaf_a = a.mesh().regions().region(listed.pair.a);
  const Region& leaf_b = b.mesh().regions().region(listed.pair.b);
  const double motion = front.motion_now(a, b);
  const double lower = static_cast<double>(listed.lower) - motion;
  const double looked =
      static_cast<double>(front.apart) > motion ? static_cast<double>(listed.looked) - motion : 0;
  if (lower_now(a, leaf_a, b, leaf_b) >= std::max(lower, looked)) return;
  const CornersOf of_a(a, leaf_a);
  const CornersOf of_b(b, leaf_b);
  require_apart(of_a, of_b, lower, "listed leaves are nearer than their bound", listed.pair.a);
  require_features_apart(of_a, of_b, looked, "listed leaves are nearer than looks said", listed.pair.a);
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

void validate_blocks(const Surface& surface, const VertexBlocks& blocks) {
  std::uint32_t blocks_each = 1;
  for (std::size_t index = 0; index < blocks.level_count(); ++index) {
    const VertexBlocks::Level level = blocks.level(index);
    for (std::uint32_t block = 0; block < blocks.level(0).count; ++block)
      for (const std::uint32_t vertex : blocks.vertices(block)) {
        const Eigen::Array3d place = surface.position(vertex) - blocks.origin();
        const Eigen::Array3d slack = place.abs() * 0x1p-23 + 0x1p-140;
        for (int axis = 0; axis < 3; ++axis) {
          const float* const row =
              level.rows + static_cast<std::size_t>(axis) * level.stride + block / blocks_each;
          require(row[0] <= place[axis] + slack[axis] && row[3 * level.stride] >= place[axis] - slack[axis],
                  "a vertex is outside its block's box", vertex);
        }
      }
    blocks_each *= VertexBlocks::group_size;
  }
}

void validate_near_part(const Surface& surface, const Box& box, double reach,
                        std::span<const std::uint32_t> listed) {
  require(surface.has_stretches(), "stretches are those of other positions", 0);
  std::vector<bool> is_listed(surface.mesh().vertex_count());
  for (const std::uint32_t vertex : listed) is_listed[vertex] = true;
  for (std::uint32_t vertex = 0; vertex < surface.mesh().vertex_count(); ++vertex) {
    const Eigen::Vector3d place = surface.position(vertex);
    const double beyond = std::max((box.min - place).maxCoeff(), (place - box.max).maxCoeff());
    require(is_listed[vertex] || beyond >= reach, "a vertex is near and not listed", vertex);
  }
}

/// By the leaves' own points where boxes do not settle it: a front may be made by boxes of an earlier refit,
/// and neither those nor the boxes of now always give the greater bound.
void validate(const LeafFront& front, const Surface& a, const Surface& b) {
  const auto regions_a = a.mesh().regions().regions();
  const auto regions_b = b.mesh().regions().regions();
  const double beyond = front.beyond_now(a, b);
  if (!(beyond > 0) || regions_a.size() * regions_b.size() > 4096) return;
  std::set<std::pair<std::uint32_t, std::uint32_t>> listed;
  for (const ListedLeaves& leaves : front.leaves) {
    listed.insert({leaves.pair.a, leaves.pair.b});
    validate_listed(leaves, front, a, b);
  }
  for (std::uint32_t i = 0; i < regions_a.size(); ++i)
    for (std::uint32_t j = 0; j < regions_b.size(); ++j) {
      if (!regions_a[i].is_leaf() || !regions_b[j].is_leaf() || listed.contains({i, j})) continue;
      if (lower_now(a, regions_a[i], b, regions_b[j]) >= beyond) continue;
      require_apart(CornersOf(a, regions_a[i]), CornersOf(b, regions_b[j]), beyond, "a front misses leaves",
                    i);
    }
}

}  // namespace graze
#else
namespace graze {
void validate(const RegionTree& /*tree*/, const Mesh& /*mesh*/) {}
void validate(const Surface& /*surface*/) {}
void validate_blocks(const Surface& /*surface*/, const VertexBlocks& /*blocks*/) {}
void validate_near_part(const Surface& /*surface*/, const Box& /*box*/, double /*reach*/,
                        std::span<const std::uint32_t> /*listed*/) {}
void validate(const LeafFront& /*front*/, const Surface& /*a*/, const Surface& /*b*/) {}
}  // namespace graze
#endif
