#include "page/mesh_table.hpp"

#include <span>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"
#include "page/page_table.hpp"

namespace graze::io {
namespace {

using Numbers = std::vector<std::uint32_t>;

template <typename Number>
void add_list(PageTable& table, std::string_view name, const std::vector<Number>& numbers) {
  table.add(name, std::span<const Number>(numbers));
}

/// Triangles, then quads, each in the caller's order. The order is listed if the mesh has both.
void add_faces(PageTable& table, const Mesh& mesh, const MeshCounts& counts) {
  Numbers triangles;
  Numbers quads;
  Numbers order;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const auto corners = mesh.face(face);
    Numbers& list = corners.size() == 3 ? triangles : quads;
    const std::size_t before = list.size() / corners.size() + (corners.size() == 3 ? 0 : counts.triangles);
    order.push_back(static_cast<std::uint32_t>(before));
    list.insert(list.end(), corners.begin(), corners.end());
  }
  add_list(table, "triangles", triangles);
  add_list(table, "quads", quads);
  if (counts.triangles > 0 && counts.quads > 0) add_list(table, "face_order", order);
}

void add_edges(PageTable& table, const Mesh& mesh) {
  Numbers edges;
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge)
    for (const std::uint32_t vertex : mesh.edge(edge)) edges.push_back(vertex);
  add_list(table, "edges", edges);
}

void add_rest(PageTable& table, const Mesh& mesh) {
  std::vector<double> rest;
  for (const Eigen::Vector3d& point : mesh.rest()) rest.insert(rest.end(), point.begin(), point.end());
  add_list(table, "rest", rest);
}

void add_regions(PageTable& table, const RegionTree& tree) {
  std::vector<std::uint8_t> levels;
  Numbers parents;
  Numbers middles;
  Numbers begins;
  Numbers ends;
  for (const Region& region : tree.regions()) {
    levels.push_back(static_cast<std::uint8_t>(region.level));
    parents.push_back(region.parent);
    middles.push_back(region.middle);
    begins.push_back(region.first_vertex);
    ends.push_back(region.first_vertex + region.vertex_count);
  }
  add_list(table, "region_level", levels);
  add_list(table, "region_parent", parents);
  add_list(table, "region_middle", middles);
  add_list(table, "region_begin", begins);
  add_list(table, "region_end", ends);
  table.add("region_vertices", tree.vertices());
}

}  // namespace

MeshCounts page_counts_of(const Mesh& mesh) {
  MeshCounts counts{mesh.vertex_count(), mesh.edge_count(), 0, 0, indexed(mesh).regions().level_count()};
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    ++(mesh.face(face).size() == 3 ? counts.triangles : counts.quads);
  return counts;
}

std::string mesh_table(const Mesh& mesh) {
  PageTable table;
  add_faces(table, mesh, page_counts_of(mesh));
  add_edges(table, mesh);
  add_rest(table, mesh);
  add_regions(table, indexed(mesh).regions());
  return table.bytes();
}

}  // namespace graze::io
